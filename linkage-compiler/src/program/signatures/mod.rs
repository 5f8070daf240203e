//! The signatures of the functions of a driver: names, arguments and return types. A stub has nothing else.

mod declared;
mod equations;
mod family;
mod form;
mod motion;
mod position;

use super::branch::Position;
use super::expression::Type;
use super::function::{Argument, Body, Function, Passed};
use super::names::{Arguments, Order, TypeNames, type_names};
use crate::ids::{ColumnId, InputId, Table, UnknownId};
use crate::model::{Driver, Mechanism, Request};
use std::collections::BTreeSet;

pub use declared::{Coordinate, Name, Parameter, UserFunction};
pub use family::Family;
pub use form::{fallible, total};

/// The functions of one driver of a mechanism, without bodies: plain data. Attributes, visibility, paths and places in the text
/// stay in the [`Mechanism`], which printers read besides.
#[derive(Debug, Clone)]
pub struct Signatures {
    /// The names of the mechanism and of the driver.
    pub mechanism: String,
    pub driver: String,
    pub parameters: Vec<Parameter>,
    /// All coordinates in the order of their fields, the dependent ones, and the inputs.
    pub coordinates: Table<ColumnId, Coordinate>,
    pub unknowns: Table<UnknownId, Coordinate>,
    pub inputs: Table<InputId, Coordinate>,
    pub points: Vec<Name>,
    pub outputs: Vec<Name>,
    /// The coordinates and outputs with a range.
    pub ranges: Vec<String>,
    pub user_functions: Vec<UserFunction>,
    pub requests: BTreeSet<Request>,
    /// True if loops or equations are declared as implied by others.
    pub has_implied: bool,
    /// True for an open chain, which has no equations.
    pub is_open: bool,
    /// True if scenes call its functions.
    pub has_scenes: bool,
    /// The number of forces in joints that its drawing can show.
    pub drawn_forces: usize,
    pub types: TypeNames,
    pub arguments: Arguments,
}

impl Signatures {
    pub fn new(mechanism: &Mechanism, driver: &Driver) -> Self {
        let parameters = mechanism.parameters.iter().map(|parameter| Parameter::of(&mechanism.graph, parameter));
        Self {
            mechanism: mechanism.name.to_string(),
            driver: driver.name.to_string(),
            parameters: parameters.collect(),
            coordinates: Coordinate::all(mechanism, &mechanism.coordinate_order(driver)),
            unknowns: Coordinate::all(mechanism, &driver.unknowns),
            inputs: Coordinate::all(mechanism, &driver.inputs),
            points: mechanism.points.iter().map(|point| (&point.name).into()).collect(),
            outputs: mechanism.outputs.iter().map(|output| (&output.name).into()).collect(),
            ranges: mechanism.ranges.iter().map(|range| range.name.clone()).collect(),
            user_functions: mechanism.externals.iter().map(UserFunction::from).collect(),
            requests: mechanism.requests.clone(),
            has_implied: !mechanism.implied.is_empty(),
            is_open: mechanism.is_open(),
            has_scenes: mechanism.scenes_of(driver).next().is_some(),
            drawn_forces: mechanism.drawn_forces(),
            types: type_names(mechanism, driver),
            arguments: Arguments::new(mechanism),
        }
    }

    /// All signatures in the order of emission: the most used first.
    pub fn all(&self, position: &Position) -> Vec<Function<Body>> {
        let wants = |request| self.requests.contains(&request);
        let families = || [Family::Points, Family::Outputs].into_iter().filter(|&family| self.has(family));
        let mut all = vec![self.kinematics(position)];
        if self.has_quantities() {
            all.push(self.full_kinematics(position));
        }
        all.push(self.motion());
        all.extend(self.assemblies(position));
        if !self.is_open {
            all.extend([self.branch_of(), self.branch_near(), self.solve(), self.solve_any_branch()]);
        }
        all.push(self.pose_at());
        if self.has_implied {
            all.push(self.check_implied());
        }
        if !self.ranges.is_empty() {
            all.push(self.ranges());
        }
        all.extend([self.velocity(), self.acceleration()]);
        if wants(Request::Jerk) {
            all.push(self.jerk());
        }
        for family in families() {
            all.extend((0..self.orders()).map(|order| self.quantities(family, order)));
        }
        if wants(Request::Limits) {
            all.extend(self.inputs.ids().map(|index| self.limits(position, index)));
        }
        if !self.is_open {
            all.push(self.velocity_ratios());
        }
        all.extend(families().map(|family| self.quantity_ratios(family)));
        if wants(Request::VelocityRatioDerivatives) {
            all.extend((!self.is_open).then(|| self.ratio_derivatives()));
            all.extend(families().map(|family| self.quantity_ratio_derivatives(family)));
        }
        if wants(Request::Sensitivity) {
            all.extend((!self.is_open).then(|| self.sensitivity()));
            all.extend(families().map(|family| self.quantity_sensitivities(family)));
        }
        if wants(Request::Drawing) {
            // The number of joints is that of the finished mechanism.
            all.push(self.joints(0));
        }
        if !self.is_open {
            all.extend(self.equations(position));
        }
        all
    }

    /// Psi, its derivatives, and linear systems in J.
    fn equations(&self, position: &Position) -> [Function<Body>; 11] {
        [
            self.residual(),
            self.residual_scales(),
            self.jacobian(),
            self.jacobian_unknowns(),
            self.jacobian_inputs(),
            self.jacobian_unknowns_scales(),
            self.jacobian_inputs_scales(),
            self.determinant(),
            self.block_determinants(position.groups),
            self.gamma(),
            self.solve_jacobian(),
        ]
    }

    pub(super) fn pose(&self) -> Argument {
        Argument { name: self.arguments.pose.clone(), passed: Passed::ByReference(self.pose_type()) }
    }

    pub(super) fn branch(&self) -> Argument {
        let of = Type::Bare(self.types.branch.clone());
        Argument { name: self.arguments.branch.clone(), passed: Passed::ByValue(of) }
    }

    fn error_name(&self) -> Argument {
        Argument { name: self.arguments.error_name.clone(), passed: Passed::ByValue(Type::Text) }
    }

    /// All coordinates, or their derivatives with respect to time.
    pub(super) fn coordinates(&self, order: Order) -> Argument {
        let passed = Passed::ByReference(self.coordinates_type(order));
        Argument { name: self.arguments.of(order).to_owned(), passed }
    }

    fn guess(&self) -> Argument {
        Argument { name: self.arguments.guess.clone(), ..self.coordinates(Order::Value) }
    }

    /// The inputs, or their derivatives with respect to time, as `impl Into`.
    fn inputs_by(&self, order: Order) -> Argument {
        let of = Type::Own(self.types.inputs.clone());
        Argument { name: self.arguments.of_inputs(order).to_owned(), passed: Passed::Converted(of) }
    }

    /// The rates of the inputs by value.
    fn input_rates(&self) -> Argument {
        let of = Type::Own(self.types.inputs.clone());
        Argument { name: self.arguments.input_rates.clone(), passed: Passed::ByValue(of) }
    }

    pub fn pose_type(&self) -> Type {
        Type::Own(self.types.pose.clone())
    }

    pub fn coordinates_type(&self, order: Order) -> Type {
        Type::Own(order.type_of(&self.types).to_owned())
    }
}
