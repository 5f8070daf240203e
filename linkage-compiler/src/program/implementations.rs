//! The traits that a driver implements: `Mechanism` and `Kinematic`, `Assembly` if its position has a closed form, `Branches`
//! if all positions are listed, `Lanes` and `Skeleton` on request.

use linkage_ir::Intrinsic;

use super::Derived;
use super::branch::Position;
use super::branch_functions::of_branch;
use super::expression::{Expression, Pattern, Type};
use super::function::{Access, Body, Function, Passed};
use super::functions::Functions;
use super::implementation::{
    Associated, ConstantValue, Implementation, Implemented, fallible_of_trait, named_coordinates, of_trait,
};
use super::lane_columns::Column;
use super::lane_functions;
use super::names::Order;
use super::pose_functions::of_pose;
use super::ranges;
use super::signatures::{Family, Signatures};
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
    all.push(of.mechanism());
    all.push(of.kinematic());
    all.extend(position.is_closed.then(|| of.assembly()));
    all.extend(has("branches").then(|| of.branches()));
    let wants = |request| signatures.requests.contains(&request);
    let lanes = wants(Request::Lanes).then(|| lane_functions::of_driver(signatures, position, functions, derived));
    let (lanes, columns) = lanes.unzip();
    all.extend(lanes);
    all.extend(wants(Request::Drawing).then(|| of.skeleton()));
    (all, columns.unwrap_or_default())
}

struct Traits<'a> {
    signatures: &'a Signatures,
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

    fn mechanism(&self) -> Implementation<Body> {
        let [unknowns, are_unknown_angles] = named_coordinates(&self.signatures.unknowns);
        let [inputs, are_input_angles] = named_coordinates(&self.signatures.inputs);
        let groups = self.derived.map(|derived| derived.groups.clone()).unwrap_or_default();
        let [u, v, g] = [self.signatures.unknowns.len(), self.signatures.inputs.len(), self.position.groups];
        let own = |order| Associated::Type(self.signatures.coordinates_type(order));
        let types = vec![
            ("Scalar", Associated::Type(Type::Scalar)),
            ("Name", Associated::Text),
            ("U", Associated::Dimension(u)),
            ("V", Associated::Dimension(v)),
            ("G", Associated::Dimension(g)),
            ("Coordinates", own(Order::Value)),
            ("Rates", own(Order::Rate)),
            ("Inputs", Associated::Type(Type::Own(self.signatures.types.inputs.clone()))),
            ("Pose", Associated::Type(self.signatures.pose_type())),
            ("Branch", Associated::Type(self.branch())),
        ];
        let mut constants = vec![
            ("NAME", ConstantValue::Own),
            ("UNKNOWNS", unknowns),
            ("INPUTS", inputs),
            ("UNKNOWN_ANGLES", are_unknown_angles),
            ("INPUT_ANGLES", are_input_angles),
            ("GROUPS", ConstantValue::Groups(groups)),
        ];
        let mut functions = self.on_positions().to_vec();
        functions.extend(self.signatures.has_implied.then(|| {
            let pose = Expression::own_call("pose_at", [Expression::name("q")]);
            let value = Expression::own_call("check_implied", [pose.borrowed()]);
            fallible_of_trait("check_implied", [coordinates("q")], Type::Tuple(Vec::new()), Body::result(value))
        }));
        if !self.signatures.ranges.is_empty() {
            constants.push(("RANGES", ConstantValue::Texts(self.signatures.ranges.clone())));
            functions.push(ranged_at());
        }
        self.implementation(Implemented::Mechanism, types, constants, functions)
    }

    fn on_positions(&self) -> [Function<Body>; 3] {
        let value = Expression::own_call("pose_at", [Expression::name("q")]);
        let pose_at = of_trait("pose_at", [coordinates("q")], Type::OfTrait("Pose"), Body::plain(value));
        let value = Expression::call(Intrinsic::IsFinite, [Expression::name("pose")]);
        let is_finite = of_trait("is_finite", [pose()], Type::Flag, Body::plain(value));
        let branch_of = match self.signatures.is_open {
            true => Expression::of_type(self.branch(), Intrinsic::OnlyBranch, []),
            false => Expression::own_call("branch_of", [Expression::name("pose")]),
        };
        let branch_of = of_trait("branch_of", [pose()], Type::OfTrait("Branch"), Body::plain(branch_of));
        [pose_at, Function { is_method: false, ..is_finite }, branch_of]
    }

    /// Velocities and accelerations, points and outputs: the functions of the type itself under its names in the trait.
    fn kinematic(&self) -> Implementation<Body> {
        let types = &self.signatures.types;
        let families = [("P", "Points", "POINTS", Family::Points), ("O", "Outputs", "OUTPUTS", Family::Outputs)];
        let accelerations = Associated::Type(self.signatures.coordinates_type(Order::Acceleration));
        let count = self.signatures.unknowns.len() + self.signatures.inputs.len();
        let mut own = vec![("N", Associated::Dimension(count)), ("Accelerations", accelerations)];
        let mut constants = Vec::new();
        let mut functions = vec![self.coordinates_of()];
        functions.extend([Order::Rate, Order::Acceleration].map(|order| self.of_coordinates(order)));
        functions.extend((!self.signatures.is_open).then(|| self.velocity_ratios()));
        for (number, each, list, family) in families {
            let names = family.names_as_written(self.signatures);
            own.push((number, Associated::Dimension(names.len())));
            let has_some = self.signatures.has(family);
            let name = has_some.then(|| self.signatures.each_name(family).to_owned());
            own.push((each, Associated::PerQuantity(name)));
            if has_some {
                constants.push((list, ConstantValue::Texts(names)));
                functions.extend((0..3).map(|order| self.quantities(family, order)));
                functions.push(self.quantity_ratios(family));
            }
        }
        let near = if self.position.is_closed { "" } else { "_near" };
        let moving = ["guess", "branch", "input_rates", "input_accelerations"];
        functions.push(self.forward("kinematics", &format!("kinematics{near}"), moving, &types.kinematics));
        functions.extend(self.signatures.has_quantities().then(|| {
            self.forward("full_kinematics", &format!("full_kinematics{near}"), moving, &types.full_kinematics)
        }));
        functions.push(self.forward("motion", "motion", ["q", "input_rates", "input_accelerations"], &types.motion));
        self.implementation(Implemented::Kinematic, own, constants, functions)
    }

    fn coordinates_of(&self) -> Function<Body> {
        let value = Expression::call(Intrinsic::Coordinates, [Expression::name("pose")]);
        let function = of_trait("coordinates_of", [pose()], Type::OfTrait("Coordinates"), Body::plain(value));
        Function { is_method: false, ..function }
    }

    /// `velocity` or `acceleration`.
    fn of_coordinates(&self, order: Order) -> Function<Body> {
        let of = order.type_of(&self.signatures.types);
        match order {
            Order::Rate => self.forward("velocity", "velocity", ["pose", "input_rates"], of),
            _ => self.forward("acceleration", "acceleration", ["pose", "rates", "input_accelerations"], of),
        }
    }

    fn velocity_ratios(&self) -> Function<Body> {
        let [u, v] = [self.signatures.unknowns.len(), self.signatures.inputs.len()];
        let ratios = Expression::own_call("velocity_ratios", [Expression::name("pose")]).tried().converted();
        fallible_of_trait("velocity_ratios", [pose()], Type::Sized("Matrix", vec![u, v]), Body::plain(ratios))
    }

    fn quantities(&self, family: Family, order: usize) -> Function<Body> {
        let Function { name, returns, .. } = self.signatures.quantities(family, order);
        match order {
            0 => forwarded(&name, &name, ["pose"], returns),
            1 => forwarded(&name, &name, ["pose", "rates"], returns),
            _ => forwarded(&name, &name, ["pose", "rates", "accelerations"], returns),
        }
    }

    fn quantity_ratios(&self, family: Family) -> Function<Body> {
        let name = self.signatures.quantity_ratios(family).name;
        let ratios = Expression::own_call(&name, [Expression::name("pose")]).tried();
        let ratios = Expression::call(Intrinsic::EachSized, [ratios]);
        let matrix = Type::Sized("Matrix", vec![family.dimension(), self.signatures.inputs.len()]);
        let returns = Type::Each(self.signatures.each_name(family).to_owned(), Box::new(matrix));
        fallible_of_trait(&name, [pose()], returns, Body::plain(ratios))
    }

    /// A function of the trait that calls one of the type itself.
    fn forward<const N: usize>(&self, name: &str, to: &str, arguments: [&'static str; N], of: &str) -> Function<Body> {
        forwarded(name, to, arguments, Type::Own(of.to_owned()))
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
        self.implementation(Implemented::Assembly, Vec::new(), Vec::new(), functions)
    }

    fn branches(&self) -> Implementation<Body> {
        let found = || Expression::name("found");
        let coordinates = Expression::call(Intrinsic::Coordinates, [found().field("pose")]);
        let each = Expression::Closure {
            arguments: vec![Pattern::bound("found".to_owned())],
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
        self.implementation(Implemented::Branches, Vec::new(), Vec::new(), vec![all])
    }

    fn skeleton(&self) -> Implementation<Body> {
        let skeleton = self.derived.map(|derived| derived.skeleton.clone()).unwrap_or_default();
        let count = 2 * skeleton.joints.len();
        let names = skeleton.joints.into_iter().map(|(name, _)| name).collect();
        let constants = vec![("JOINTS", ConstantValue::Texts(names)), ("PARTS", ConstantValue::Parts(skeleton.parts))];
        let joints = Expression::own_call("joints", [Expression::name("pose")]).converted();
        let returns = Type::Column(Box::new(Type::Scalar), count);
        let mut functions = vec![of_trait("joints", [pose()], returns, Body::plain(joints))];
        let one_of = |name, all, size| {
            let all = Expression::own_call(all, [Expression::name("pose")]);
            let found = Expression::call(Intrinsic::Get, [all, Expression::name("place")]);
            let found = Expression::call(Intrinsic::Copied, [found]);
            let returns = Type::Around("Option", Box::new(Type::List(Box::new(Type::Scalar), size)));
            of_trait(name, [pose(), ("place", Passed::ByValue(Type::Count))], returns, Body::plain(found))
        };
        functions.extend((!skeleton.guides.is_empty()).then(|| one_of("guide", "guides", 2)));
        let has_forces = self.signatures.drawn_forces > 0;
        functions.extend(has_forces.then(|| one_of("force_place", "force_places", 4)));
        self.implementation(Implemented::Skeleton, vec![("Parts", Associated::Dimension(count))], constants, functions)
    }

    fn branch(&self) -> Type {
        Type::Bare(self.signatures.types.branch.clone())
    }
}

fn pose() -> (&'static str, Passed) {
    ("pose", Passed::ByReference(Type::OfTrait("Pose")))
}

/// A function of a trait that calls one of the type itself with the same arguments.
fn forwarded<const N: usize>(name: &str, to: &str, arguments: [&'static str; N], returns: Type) -> Function<Body> {
    let call = Expression::own_call(to, arguments.map(Expression::name));
    let of = |argument| match argument {
        "pose" => Passed::ByReference(Type::OfTrait("Pose")),
        "q" | "guess" => Passed::ByReference(Type::OfTrait("Coordinates")),
        "rates" => Passed::ByReference(Type::OfTrait("Rates")),
        "accelerations" => Passed::ByReference(Type::OfTrait("Accelerations")),
        "branch" => Passed::ByValue(Type::OfTrait("Branch")),
        _ => Passed::ByValue(Type::OfTrait("Inputs")),
    };
    fallible_of_trait(name, arguments.map(|argument| (argument, of(argument))), returns, Body::result(call))
}

/// The value with a range at a place of the list `ranges`.
fn ranged_at() -> Function<Body> {
    let all = Expression::own_call("ranges", [Expression::name("q")]);
    let found = Expression::call(Intrinsic::Get, [all, Expression::name("place")]);
    let found = Expression::call(Intrinsic::Copied, [found]);
    let returns = Type::Around("Option", Box::new(ranges::ranged()));
    of_trait("ranged", [("place", Passed::ByValue(Type::Count)), coordinates("q")], returns, Body::plain(found))
}

fn coordinates(name: &'static str) -> (&'static str, Passed) {
    (name, Passed::ByReference(Type::OfTrait("Coordinates")))
}
