//! The functions of a pose.

use super::Derived;
use super::doc::lines;
use super::expression::{Expression, Type};
use super::function::{Body, Function};
use super::implementation::{Implementation, Implemented};
use super::names::Order;
use super::pose::PosePlan;
use super::pose_fields::Held;
use super::signatures::{Signatures, total};
use linkage_ir::Operations;

/// `is_finite` and `coordinates`; without derived data, their signatures.
pub(super) fn of_pose(signatures: &Signatures, derived: Option<&Derived>) -> Implementation<Body> {
    let is_finite = Function {
        doc: lines(["Returns true if every number of this position is finite."]),
        body: derived.map(|derived| Body::plain(Expression::are_finite(numbers(&derived.pose)))),
        ..total("is_finite", [], Type::Flag)
    };
    let of = signatures.coordinates_type(Order::Value);
    let coordinates = Function {
        doc: lines([
            "The coordinates of this position. An angle that is stored as a direction costs an arc tangent",
            "and is returned between -pi and pi. It does not fail: if a number is not finite, the result",
            "is not finite or meaningless.",
        ]),
        body: derived.map(|derived| coordinates_of(&derived.held, of.clone())),
        ..total("coordinates", [], of)
    };
    Implementation {
        of: Implemented::Itself,
        on: signatures.types.pose.clone(),
        is_generic: true,
        error: "PositionError",
        types: Vec::new(),
        constants: Vec::new(),
        functions: vec![is_finite, coordinates],
    }
}

/// Every number of a pose.
fn numbers(pose: &PosePlan) -> Vec<Expression> {
    let field = |name: &String| Expression::own().field(name);
    let parts = pose.directions.values().flat_map(|name| ["re", "im"].map(|part| field(name).field(part)));
    let values = pose.values.iter().map(|(_, name, _)| name);
    let determinants = pose.determinants.iter().map(|(_, name, _)| name);
    let externals = pose.externals.iter().map(|(_, name, _)| name);
    parts.chain(values.chain(determinants).chain(externals).map(field)).collect()
}

fn coordinates_of(held: &[(String, Held)], of: Type) -> Body {
    let pose = Expression::own();
    let members = held.iter().map(|(name, held)| (name.clone(), held.value(&pose)));
    let functions = held.iter().filter(|(_, held)| held.computed_from(&pose).is_some()).count();
    let operations = Operations { functions, ..Operations::default() };
    Body { operations, ..Body::plain(Expression::structure(of, members)) }
}
