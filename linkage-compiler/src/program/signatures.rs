//! The signatures of the functions of a driver: names, arguments and return types. A stub has nothing else.

use super::branch::Position;
use super::expression::Type;
use super::function::{Access, Argument, Body, Function, Passed};
use super::names::{Arguments, Order, TypeNames};
use crate::ids::InputId;
use crate::model::{Driver, Mechanism, Request};

/// The functions of one driver of a mechanism, without bodies.
pub struct Signatures<'a> {
    pub mechanism: &'a Mechanism,
    pub driver: &'a Driver,
    pub types: TypeNames,
    pub arguments: Arguments,
}

/// The points or the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    Points,
    Outputs,
}

impl Family {
    pub fn word(self) -> &'static str {
        match self {
            Self::Points => "point",
            Self::Outputs => "output",
        }
    }

    /// The components of one: 2 of a point, 1 of an output.
    pub fn dimension(self) -> usize {
        self.axes().len()
    }

    /// The endings of the names of the components.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Points => &["_x", "_y"],
            Self::Outputs => &[""],
        }
    }

    /// The field names of all points or outputs.
    pub fn names(self, mechanism: &Mechanism) -> Vec<String> {
        match self {
            Self::Points => mechanism.points.iter().map(|point| point.name.field.clone()).collect(),
            Self::Outputs => mechanism.outputs.iter().map(|output| output.name.field.clone()).collect(),
        }
    }
}

/// The endings of function names, by the order of the derivative with respect to time.
pub const ORDERS: [&str; 4] = ["s", "_velocities", "_accelerations", "_jerks"];

impl<'a> Signatures<'a> {
    pub fn new(mechanism: &'a Mechanism, driver: &'a Driver) -> Self {
        let (types, arguments) = (TypeNames::new(mechanism, driver), Arguments::new(mechanism));
        Self { mechanism, driver, types, arguments }
    }

    /// All signatures in the order of emission: the most used first.
    pub fn all(&self, position: &Position) -> Vec<Function<Body>> {
        let wants = |request| self.mechanism.requests.contains(&request);
        let families = || [Family::Points, Family::Outputs].into_iter().filter(|&family| self.has(family));
        let mut all = vec![self.kinematics(position)];
        if self.has_quantities() {
            all.push(self.full_kinematics(position));
        }
        all.push(self.motion());
        all.extend(self.assemblies(position));
        if !self.is_open() {
            all.extend([self.branch_of(), self.branch_near(), self.solve(), self.solve_any_branch()]);
        }
        all.push(self.pose_at());
        if !self.mechanism.implied.is_empty() {
            all.push(self.check_implied());
        }
        all.extend([self.velocity(), self.acceleration()]);
        if wants(Request::Jerk) {
            all.push(self.jerk());
        }
        for family in families() {
            all.extend((0..self.orders()).map(|order| self.quantities(family, order)));
        }
        if wants(Request::Limits) {
            all.extend(self.driver.inputs.ids().map(|place| self.limits(position, place)));
        }
        if !self.is_open() {
            all.push(self.velocity_ratios());
        }
        all.extend(families().map(|family| self.quantity_ratios(family)));
        if wants(Request::VelocityRatioDerivatives) {
            all.extend((!self.is_open()).then(|| self.ratio_derivatives()));
            all.extend(families().map(|family| self.quantity_ratio_derivatives(family)));
        }
        if wants(Request::Sensitivity) {
            all.extend((!self.is_open()).then(|| self.sensitivity()));
            all.extend(families().map(|family| self.quantity_sensitivities(family)));
        }
        if wants(Request::Drawing) {
            // The number of joints is that of the finished mechanism.
            all.push(self.joints(0));
        }
        if !self.is_open() {
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
            self.block_determinants(position.blocks),
            self.gamma(),
            self.solve_jacobian(),
        ]
    }

    /// True for an open chain, which has no equations.
    pub fn is_open(&self) -> bool {
        self.mechanism.is_open()
    }

    /// True if points, or outputs, are declared.
    pub fn has(&self, family: Family) -> bool {
        match family {
            Family::Points => !self.mechanism.points.is_empty(),
            Family::Outputs => !self.mechanism.outputs.is_empty(),
        }
    }

    /// True if points or outputs are declared.
    pub fn has_quantities(&self) -> bool {
        self.has(Family::Points) || self.has(Family::Outputs)
    }

    /// The number of functions of points and outputs: values, velocities, accelerations, with `derive jerk` jerks.
    pub fn orders(&self) -> usize {
        if self.mechanism.requests.contains(&Request::Jerk) { 4 } else { 3 }
    }

    pub fn unknowns(&self) -> usize {
        self.driver.unknowns.len()
    }

    pub fn inputs(&self) -> usize {
        self.driver.inputs.len()
    }

    // Position.

    pub fn pose_at(&self) -> Function<Body> {
        let is_layer = self.mechanism.scenes_of(self.driver).next().is_some();
        let access = if is_layer { Access::PublicLayer } else { Access::PublicInlined };
        Function { access, ..total("pose_at", [self.coordinates(Order::Value)], self.pose_type()) }
    }

    pub fn solve(&self) -> Function<Body> {
        let solution = Type::Around("Solution", Box::new(self.coordinates_type(Order::Value)));
        fallible("solve", [self.guess()], solution)
    }

    pub fn solve_any_branch(&self) -> Function<Body> {
        let found = Type::Around("AnyBranch", Box::new(self.coordinates_type(Order::Value)));
        fallible("solve_any_branch", [self.guess()], found)
    }

    /// The functions that assemble a position, and `branches`.
    pub fn assemblies(&self, position: &Position) -> Vec<Function<Body>> {
        if !position.is_closed {
            return vec![self.assemble_near(), self.no_assemble(position)];
        }
        let mut all = Vec::new();
        if !position.turns.is_empty() {
            all.push(self.assemble_in_turns());
        }
        all.push(self.assemble());
        if !position.turns.is_empty() {
            all.push(self.assemble_near());
        }
        if position.has_few_branches() && !self.is_open() {
            all.push(self.branches());
        }
        all
    }

    pub fn assemble(&self) -> Function<Body> {
        public_inlined(fallible("assemble", [self.inputs_by(Order::Value), self.branch()], self.pose_type()))
    }

    /// `assemble` of a mechanism without closed form: it returns an error, and a call of it is a warning that says why.
    pub fn no_assemble(&self, position: &Position) -> Function<Body> {
        let mut doc = position.obstacles();
        doc.push("Use `assemble_near` with a guess, or `solve`.".to_owned());
        let itself = fallible("assemble", [self.inputs_by(Order::Value), self.branch()], self.pose_type());
        Function { access: Access::Deprecated, doc, ..itself }
    }

    pub fn assemble_near(&self) -> Function<Body> {
        fallible("assemble_near", [self.guess(), self.branch()], self.pose_type())
    }

    pub fn assemble_in_turns(&self) -> Function<Body> {
        let inputs = Passed::ByValue(Type::Own(self.types.inputs.clone()));
        let inputs = Argument { name: self.arguments.inputs.clone(), passed: inputs };
        let turn = Argument { name: self.arguments.turn.clone(), passed: Passed::Turns };
        inlined(fallible("assemble_in_turns", [inputs, self.branch(), turn], self.pose_type()))
    }

    pub fn branches(&self) -> Function<Body> {
        let of = Type::Branches { branch: self.types.branch.clone(), pose: self.types.pose.clone() };
        fallible("branches", [self.inputs_by(Order::Value)], of)
    }

    pub fn branch_of(&self) -> Function<Body> {
        total("branch_of", [self.pose()], Type::Bare(self.types.branch.clone()))
    }

    pub fn branch_near(&self) -> Function<Body> {
        total("branch_near", [self.guess()], Type::Bare(self.types.branch.clone()))
    }

    /// The limits of one input.
    pub fn limits(&self, position: &Position, place: InputId) -> Function<Body> {
        let from = match position.is_closed {
            true => self.inputs_by(Order::Value),
            false => self.guess(),
        };
        let name = match self.inputs() {
            1 => "limits".to_owned(),
            _ => format!("limits_of_{}", self.mechanism.coordinates[self.driver.inputs[place]].name.field),
        };
        fallible(name, [from, self.branch()], Type::Runtime("Limits", Vec::new()))
    }

    /// x and y of each joint.
    pub fn joints(&self, count: usize) -> Function<Body> {
        total("joints", [self.pose()], Type::Vector(2 * count))
    }

    // Equations and their derivatives.

    pub fn residual(&self) -> Function<Body> {
        total("residual", [self.pose()], Type::Vector(self.unknowns()))
    }

    pub fn residual_scales(&self) -> Function<Body> {
        total("residual_scales", [self.pose()], Type::Vector(self.unknowns()))
    }

    pub fn jacobian_unknowns(&self) -> Function<Body> {
        total("jacobian_unknowns", [self.pose()], Type::Matrix(self.unknowns(), self.unknowns()))
    }

    pub fn jacobian_inputs(&self) -> Function<Body> {
        total("jacobian_inputs", [self.pose()], Type::Matrix(self.unknowns(), self.inputs()))
    }

    pub fn jacobian(&self) -> Function<Body> {
        total("jacobian", [self.pose()], Type::Matrix(self.unknowns(), self.unknowns() + self.inputs()))
    }

    pub fn jacobian_unknowns_scales(&self) -> Function<Body> {
        hidden("jacobian_unknowns_scales", [self.pose()], Type::Matrix(self.unknowns(), self.unknowns()))
    }

    pub fn jacobian_inputs_scales(&self) -> Function<Body> {
        hidden("jacobian_inputs_scales", [self.pose()], Type::Matrix(self.unknowns(), self.inputs()))
    }

    pub fn determinant(&self) -> Function<Body> {
        total("determinant", [self.pose()], Type::Scalar)
    }

    pub fn block_determinants(&self, blocks: usize) -> Function<Body> {
        total("block_determinants", [self.pose()], Type::List(Box::new(Type::Scalar), blocks))
    }

    pub fn length_scale(&self) -> Function<Body> {
        hidden("length_scale", [self.pose()], Type::Scalar)
    }

    // Linear systems in J.

    pub fn solve_jacobian(&self) -> Function<Body> {
        let vector = Type::Vector(self.unknowns());
        let right = Argument { name: self.arguments.right.clone(), passed: Passed::ByReference(vector.clone()) };
        fallible("solve_jacobian", [self.pose(), right], vector)
    }

    pub fn velocity_ratios(&self) -> Function<Body> {
        fallible("velocity_ratios", [self.pose()], Type::Matrix(self.unknowns(), self.inputs()))
    }

    // Functions that those of scenes call.

    /// W, column by column.
    pub fn ratio_columns(&self) -> Function<Body> {
        layer(fallible("ratio_columns", [self.pose(), self.error_name()], self.columns()))
    }

    fn columns(&self) -> Type {
        Type::List(Box::new(Type::List(Box::new(Type::Scalar), self.unknowns())), self.inputs())
    }

    pub fn coordinate_rates(&self) -> Function<Body> {
        let ratios = Argument { name: self.arguments.ratios.clone(), passed: Passed::ByReference(self.columns()) };
        let ratios = (!self.is_open()).then_some(ratios);
        let arguments = ratios.into_iter().chain([self.input_rates()]);
        let rates = layer(total("coordinate_rates", arguments, self.coordinates_type(Order::Rate)));
        Function { is_method: false, ..rates }
    }

    /// The pose, W, q', and u'' at v'' = 0.
    pub fn kinematics_at(&self) -> Function<Body> {
        let arguments = [self.coordinates(Order::Value), self.input_rates(), self.error_name()];
        let of = Type::Kinematics {
            pose: self.types.pose.clone(),
            rates: self.types.rates.clone(),
            unknowns: self.unknowns(),
            inputs: self.inputs(),
        };
        layer(fallible("kinematics_at", arguments, of))
    }

    pub fn velocity(&self) -> Function<Body> {
        let arguments = [self.pose(), self.inputs_by(Order::Rate)];
        public_inlined(fallible("velocity", arguments, self.coordinates_type(Order::Rate)))
    }

    pub fn gamma(&self) -> Function<Body> {
        total("gamma", [self.pose(), self.coordinates(Order::Rate)], Type::Vector(self.unknowns()))
    }

    pub fn acceleration(&self) -> Function<Body> {
        let arguments = [self.pose(), self.coordinates(Order::Rate), self.inputs_by(Order::Acceleration)];
        public_inlined(fallible("acceleration", arguments, self.coordinates_type(Order::Acceleration)))
    }

    pub fn jerk(&self) -> Function<Body> {
        let [rates, accelerations] = [Order::Rate, Order::Acceleration].map(|order| self.coordinates(order));
        let arguments = [self.pose(), rates, accelerations, self.inputs_by(Order::Jerk)];
        fallible("jerk", arguments, self.coordinates_type(Order::Jerk))
    }

    pub fn motion(&self) -> Function<Body> {
        let [rates, accelerations] = [Order::Rate, Order::Acceleration].map(|order| self.inputs_by(order));
        let arguments = [self.coordinates(Order::Value), rates, accelerations];
        fallible("motion", arguments, Type::Own(self.types.motion.clone()))
    }

    /// Position, velocity and acceleration from the inputs.
    pub fn kinematics(&self, position: &Position) -> Function<Body> {
        let name = if position.is_closed { "kinematics" } else { "kinematics_near" };
        fallible(name, self.moving(position), Type::Own(self.types.kinematics.clone()))
    }

    /// Position, velocity and acceleration by separate calls, where a check fails.
    pub fn kinematics_by_parts(&self, position: &Position) -> Function<Body> {
        let arguments = self.moving(position).map(|argument| match argument.passed {
            Passed::Converted(of) => Argument { passed: Passed::ByValue(of), ..argument },
            _ => argument,
        });
        let itself = fallible("kinematics_by_parts", arguments, Type::Own(self.types.kinematics.clone()));
        Function { access: Access::Cold, ..itself }
    }

    /// With points and outputs.
    pub fn full_kinematics(&self, position: &Position) -> Function<Body> {
        let name = if position.is_closed { "full_kinematics" } else { "full_kinematics_near" };
        fallible(name, self.moving(position), Type::Own(self.types.full_kinematics.clone()))
    }

    /// The inputs, or a guess, with a branch, rates and accelerations.
    fn moving(&self, position: &Position) -> [Argument; 4] {
        let from = if position.is_closed { self.inputs_by(Order::Value) } else { self.guess() };
        [from, self.branch(), self.inputs_by(Order::Rate), self.inputs_by(Order::Acceleration)]
    }

    // Points and outputs.

    /// Values, rates, accelerations or jerks.
    pub fn quantities(&self, family: Family, order: usize) -> Function<Body> {
        let motion = Order::ALL.into_iter().skip(1).take(order).map(|order| self.coordinates(order));
        let arguments = std::iter::once(self.pose()).chain(motion);
        let item = match (family, order) {
            (Family::Points, 0) => Type::Point,
            (Family::Points, _) => Type::Plane,
            (Family::Outputs, _) => Type::Scalar,
        };
        fallible(format!("{}{}", family.word(), ORDERS[order]), arguments, self.each(family, item))
    }

    pub fn quantity_ratios(&self, family: Family) -> Function<Body> {
        let item = Type::Matrix(family.dimension(), self.inputs());
        fallible(format!("{}_ratios", family.word()), [self.pose()], self.each(family, item))
    }

    pub fn ratio_derivatives(&self) -> Function<Body> {
        let of = Type::List(Box::new(Type::Matrix(self.inputs(), self.inputs())), self.unknowns());
        fallible("velocity_ratio_derivatives", [self.pose()], of)
    }

    pub fn quantity_ratio_derivatives(&self, family: Family) -> Function<Body> {
        let matrix = Type::Matrix(self.inputs(), self.inputs());
        let item = if family == Family::Points { Type::List(Box::new(matrix), 2) } else { matrix };
        fallible(format!("{}_ratio_derivatives", family.word()), [self.pose()], self.each(family, item))
    }

    pub fn sensitivity(&self) -> Function<Body> {
        fallible("sensitivity", [self.pose()], Type::Matrix(self.unknowns(), self.mechanism.parameters.len()))
    }

    pub fn quantity_sensitivities(&self, family: Family) -> Function<Body> {
        let item = Type::Matrix(family.dimension(), self.mechanism.parameters.len());
        fallible(format!("{}_sensitivities", family.word()), [self.pose()], self.each(family, item))
    }

    // Arguments and types.

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
    fn coordinates(&self, order: Order) -> Argument {
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
        Type::Own(self.types.of(order).to_owned())
    }

    fn each(&self, family: Family, item: Type) -> Type {
        Type::Each(self.each_name(family).to_owned(), Box::new(item))
    }

    /// The type with one field for each point or output.
    pub fn each_name(&self, family: Family) -> &str {
        match family {
            Family::Points => &self.types.points,
            Family::Outputs => &self.types.outputs,
        }
    }
}

/// A public function without `Result`.
pub fn total(name: impl Into<String>, arguments: impl IntoIterator<Item = Argument>, returns: Type) -> Function<Body> {
    Function {
        name: name.into(),
        doc: Vec::new(),
        access: Access::Public,
        is_method: true,
        arguments: arguments.into_iter().collect(),
        returns,
        is_fallible: false,
        body: None,
    }
}

/// A public function without `Result`, hidden from the documentation.
pub fn hidden(name: impl Into<String>, arguments: impl IntoIterator<Item = Argument>, returns: Type) -> Function<Body> {
    Function { access: Access::Hidden, ..total(name, arguments, returns) }
}

/// A private function that is inlined into functions of scenes.
fn layer(function: Function<Body>) -> Function<Body> {
    Function { access: Access::Layer, ..function }
}

/// A public function marked `#[inline]`.
fn public_inlined(function: Function<Body>) -> Function<Body> {
    Function { access: Access::PublicInlined, ..function }
}

/// A private function marked `#[inline]`.
fn inlined(function: Function<Body>) -> Function<Body> {
    Function { access: Access::Inlined, ..function }
}

/// A public function that returns a `Result`.
pub fn fallible(
    name: impl Into<String>,
    arguments: impl IntoIterator<Item = Argument>,
    returns: Type,
) -> Function<Body> {
    Function { is_fallible: true, ..total(name, arguments, returns) }
}
