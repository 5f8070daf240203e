//! The traits that a driver implements: `Mechanism`, `Assembly` if its position has a closed form, `Branches` if all
//! positions are listed, `Lanes` and `Skeleton` on request.

use super::Derived;
use super::branch::Position;
use super::branch_functions::of_branch;
use super::expression::{Expression, Pattern, Type};
use super::function::{Access, Body, Function, Passed};
use super::functions::Functions;
use super::implementation::{
    Associated, ConstantValue, Implementation, Implemented, fallible_of_trait, named_coordinates, of_trait,
};
use super::intrinsics::Intrinsic;
use super::lane_columns::Column;
use super::lane_functions;
use super::names::Order;
use super::pose_functions::of_pose;
use super::signatures::Signatures;
use crate::model::Request;

/// The implementations of a driver with these functions, and the columns of its lanes.
pub(super) fn of_driver<B>(
    signatures: &Signatures,
    position: &Position,
    functions: &Functions<B>,
    derived: Option<&Derived>,
) -> (Vec<Implementation<Body>>, Vec<Column>) {
    let has =
        |name: &str| functions.iter().any(|function| function.name == name && function.access != Access::Deprecated);
    let of = Traits { signatures, position, derived };
    let mut all = vec![of_pose(signatures, derived)];
    all.extend(of_branch(signatures, position));
    all.push(of.mechanism(has("length_scale")));
    all.extend(position.is_closed.then(|| of.assembly()));
    all.extend(has("branches").then(|| of.branches()));
    let wants = |request| signatures.mechanism.requests.contains(&request);
    let lanes = wants(Request::Lanes).then(|| lane_functions::of_driver(signatures, position, functions, derived));
    let (lanes, columns) = lanes.unzip();
    all.extend(lanes);
    all.extend(wants(Request::Drawing).then(|| of.skeleton()));
    (all, columns.unwrap_or_default())
}

struct Traits<'a> {
    signatures: &'a Signatures<'a>,
    position: &'a Position,
    derived: Option<&'a Derived>,
}

impl Traits<'_> {
    fn implementation(
        &self,
        of: Implemented,
        types: Vec<(&'static str, Associated)>,
        constants: Vec<(&'static str, ConstantValue)>,
        functions: Vec<Function<Body>>,
    ) -> Implementation<Body> {
        let on = self.signatures.types.itself.clone();
        Implementation { of, on, is_generic: true, error: "PositionError", types, constants, functions }
    }

    fn mechanism(&self, has_scale: bool) -> Implementation<Body> {
        let (mechanism, driver) = (self.signatures.mechanism, self.signatures.driver);
        let [unknowns, are_unknown_angles] = named_coordinates(mechanism, driver.unknowns.iter());
        let [inputs, are_input_angles] = named_coordinates(mechanism, driver.inputs.iter());
        let groups = self.derived.map(|derived| derived.groups.clone()).unwrap_or_default();
        let [u, v, g] = [self.signatures.unknowns(), self.signatures.inputs(), self.position.groups];
        let own = |order| Associated::Type(self.signatures.coordinates_type(order));
        let types = vec![
            ("Scalar", Associated::Type(Type::Scalar)),
            ("U", Associated::Dimension(u)),
            ("V", Associated::Dimension(v)),
            ("G", Associated::Dimension(g)),
            ("Coordinates", own(Order::Value)),
            ("Rates", own(Order::Rate)),
            ("Inputs", Associated::Type(Type::Own(self.signatures.types.inputs.clone()))),
            ("Pose", Associated::Type(self.signatures.pose_type())),
        ];
        let constants = vec![
            ("NAME", ConstantValue::Own),
            ("UNKNOWNS", unknowns),
            ("INPUTS", inputs),
            ("UNKNOWN_ANGLES", are_unknown_angles),
            ("INPUT_ANGLES", are_input_angles),
            ("GROUPS", ConstantValue::Groups(groups)),
        ];
        let mut functions = self.on_coordinates().to_vec();
        functions.extend(self.equations());
        functions.extend(has_scale.then(|| {
            let value = Expression::own_call("length_scale", [Expression::name("pose")]);
            of_trait("length_scale", [pose()], Type::Scalar, Body::plain(value))
        }));
        functions.extend((!mechanism.implied.is_empty()).then(|| {
            let pose = Expression::own_call("pose_at", [Expression::name("q")]);
            let value = Expression::own_call("check_implied", [pose.borrowed()]);
            fallible_of_trait("check_implied", [coordinates("q")], Type::Tuple(Vec::new()), Body::result(value))
        }));
        self.implementation(Implemented::Mechanism, types, constants, functions)
    }

    fn on_coordinates(&self) -> [Function<Body>; 2] {
        let value = Expression::own_call("pose_at", [Expression::name("q")]);
        let pose_at = of_trait("pose_at", [coordinates("q")], Type::OfTrait("Pose"), Body::plain(value));
        let value = Expression::call(Intrinsic::IsFinite, [Expression::name("pose")]);
        let is_finite = of_trait("is_finite", [pose()], Type::Flag, Body::plain(value));
        [pose_at, Function { is_method: false, ..is_finite }]
    }

    /// Psi, its derivatives, and linear systems in J. An open chain has no equations: all of these are empty.
    fn equations(&self) -> Vec<Function<Body>> {
        let [u, v, g] = [self.signatures.unknowns(), self.signatures.inputs(), self.position.groups];
        let is_open = self.signatures.is_open();
        let column = |rows| ("Column", Type::Column(Box::new(Type::Scalar), rows));
        let matrix = |columns| ("Matrix", Type::Sized("Matrix", vec![u, columns]));
        let of_pose = [
            ("residual", column(u)),
            ("residual_scales", column(u)),
            ("jacobian_unknowns", matrix(u)),
            ("jacobian_inputs", matrix(v)),
            ("jacobian_unknowns_scales", matrix(u)),
            ("jacobian_inputs_scales", matrix(v)),
            ("block_determinants", column(g)),
        ];
        let name = |name: &str| Expression::name(name);
        let mut functions: Vec<Function<Body>> = of_pose
            .into_iter()
            .map(|(function, (kind, returns))| {
                let value = match is_open {
                    true => Expression::zeros(kind),
                    false => Expression::own_call(function, [name("pose")]).converted(),
                };
                of_trait(function, [pose()], returns, Body::plain(value))
            })
            .collect();
        let (determinant, gamma, solution) = match is_open {
            true => (Expression::one(), Expression::zeros("Column"), name("right").dereferenced()),
            false => {
                let right = name("right").dereferenced().converted().borrowed();
                (
                    Expression::own_call("determinant", [name("pose")]),
                    Expression::own_call("gamma", [name("pose"), name("rates")]).converted(),
                    Expression::own_call("solve_jacobian", [name("pose"), right]).tried().converted(),
                )
            }
        };
        let (_, by_unknowns) = column(u);
        let rates = ("rates", Passed::ByReference(Type::OfTrait("Rates")));
        let right = ("right", Passed::ByReference(by_unknowns.clone()));
        functions.extend([
            of_trait("determinant", [pose()], Type::Scalar, Body::plain(determinant)),
            of_trait("gamma", [pose(), rates], by_unknowns.clone(), Body::plain(gamma)),
            fallible_of_trait("solve_jacobian", [pose(), right], by_unknowns, Body::plain(solution)),
        ]);
        functions
    }

    fn assembly(&self) -> Implementation<Body> {
        let call = |name: &str, arguments: [&str; 2]| {
            Body::result(Expression::own_call(name, arguments.map(Expression::name)))
        };
        let (branch, pose_type) = (Passed::ByValue(Type::OfTrait("Branch")), Type::OfTrait("Pose"));
        let inputs = ("inputs", Passed::ByValue(Type::OfTrait("Inputs")));
        let assemble = call("assemble", ["inputs", "branch"]);
        let mut functions =
            vec![fallible_of_trait("assemble", [inputs, ("branch", branch.clone())], pose_type.clone(), assemble)];
        functions.extend((!self.position.turns.is_empty()).then(|| {
            let near = call("assemble_near", ["guess", "branch"]);
            fallible_of_trait("assemble_near", [coordinates("guess"), ("branch", branch)], pose_type, near)
        }));
        let branch_of = match self.signatures.is_open() {
            true => Expression::of_type(self.branch(), Intrinsic::OnlyBranch, []),
            false => Expression::own_call("branch_of", [Expression::name("pose")]),
        };
        functions.push(of_trait("branch_of", [pose()], Type::OfTrait("Branch"), Body::plain(branch_of)));
        let types = vec![("Branch", Associated::Type(self.branch()))];
        self.implementation(Implemented::Assembly, types, Vec::new(), functions)
    }

    fn branches(&self) -> Implementation<Body> {
        let found = || Expression::name("found");
        let coordinates = Expression::call(Intrinsic::Coordinates, [found().field("pose")]);
        let each = Expression::Closure {
            arguments: vec![Pattern::name("found".to_owned())],
            statements: Vec::new(),
            value: Box::new(Expression::Tuple(vec![found().field("branch"), coordinates])),
            moves: false,
        };
        let all = Expression::own_call("branches", [Expression::name("inputs")]).tried();
        let all = Expression::call(Intrinsic::Map, [all, each]);
        let item = Type::Tuple(vec![Type::OfTrait("Branch"), Type::OfTrait("Coordinates")]);
        let inputs = ("inputs", Passed::ByValue(Type::OfTrait("Inputs")));
        let all = fallible_of_trait(
            "all_positions",
            [inputs],
            Type::Iterator { item: Box::new(item), is_cloned: false },
            Body::plain(all),
        );
        let types = vec![("Branch", Associated::Type(self.branch()))];
        self.implementation(Implemented::Branches, types, Vec::new(), vec![all])
    }

    fn skeleton(&self) -> Implementation<Body> {
        let skeleton = self.derived.map(|derived| derived.skeleton.clone()).unwrap_or_default();
        let count = 2 * skeleton.joints.len();
        let names = skeleton.joints.into_iter().map(|(name, _)| name).collect();
        let constants = vec![("JOINTS", ConstantValue::Texts(names)), ("PARTS", ConstantValue::Parts(skeleton.parts))];
        let joints = Expression::own_call("joints", [Expression::name("pose")]).converted();
        let returns = Type::Column(Box::new(Type::Scalar), count);
        let joints = of_trait("joints", [pose()], returns, Body::plain(joints));
        self.implementation(
            Implemented::Skeleton,
            vec![("Parts", Associated::Dimension(count))],
            constants,
            vec![joints],
        )
    }

    fn branch(&self) -> Type {
        Type::Bare(self.signatures.types.branch.clone())
    }
}

fn pose() -> (&'static str, Passed) {
    ("pose", Passed::ByReference(Type::OfTrait("Pose")))
}

fn coordinates(name: &'static str) -> (&'static str, Passed) {
    (name, Passed::ByReference(Type::OfTrait("Coordinates")))
}
