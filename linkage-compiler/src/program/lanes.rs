//! Position, velocity and acceleration without branches, for loops over many positions.

use super::doc::lines;
use super::expression::{Expression, Pattern, Statement, Type};
use super::function::{Access, Argument, Body, Failure, Function, Kernel, Output, Passed, results};
use super::names::Order;
use super::plan::{ENDINGS, Plan};
use super::signatures::{Family, Signatures, total};

impl Plan<'_, '_> {
    /// The formulas of `kinematics`, and those that `full_kinematics` adds. A failed check is flagged, and the lane is
    /// then computed by these functions themselves.
    pub(super) fn lanes(&mut self) {
        if !self.position.is_closed {
            return;
        }
        let (kernel, conditions) = self.kinematics_kernel(Failure::Flag);
        let value = self.kinematics_of_results(&kernel);
        let is_method = !self.signatures.is_open() || self.reads_parameters(&kernel);
        let mut body = flagged(kernel, vec![value]);
        body.before = self.turns_of_branch();
        body.after.extend(accepted(conditions));
        let doc =
            lines(["`kinematics` without branches; false if `kinematics` takes another way or returns an error."]);
        self.add(Function { is_method, ..self.signatures.kinematics_in_lane() }, doc, body);
        if self.signatures.has_quantities() {
            let kernel = self.quantities_kernel(Failure::Flag);
            let count = kernel.results.len();
            let named = kernel.results.iter().zip(self.quantity_names());
            let named = named.map(|(output, name)| Output::named(output.node, name)).collect();
            let kernel = Kernel { results: named, dyads: vec![None; count], ..kernel };
            let values = results(0..count);
            let mut body = flagged(kernel, vec![Expression::List(values)]);
            body.after.extend(accepted(Vec::new()));
            let doc = lines([
                "Value, rate and acceleration of each point and output without branches; false if `full_kinematics` takes",
                "another way or returns an error.",
            ]);
            self.add(self.signatures.quantities_in_lane(), doc, body);
        }
    }

    /// The names of points and outputs and of their derivatives, in the order of the kernel.
    fn quantity_names(&self) -> Vec<String> {
        let mechanism = self.signatures.mechanism;
        let mut names = Vec::new();
        for family in [Family::Points, Family::Outputs] {
            for name in family.names(mechanism) {
                for ending in ENDINGS.into_iter().take(3) {
                    names.extend(family.axes().iter().map(|axis| format!("{name}{axis}{ending}")));
                }
            }
        }
        names
    }
}

/// A body that returns these values and the flag.
fn flagged(kernel: Kernel, mut values: Vec<Expression>) -> Body {
    values.push(Expression::Local(0));
    Body { locals: vec!["is_accepted".to_owned()], ..Body::of(kernel, Expression::Tuple(values)) }
}

/// The statement that binds the flag.
fn accepted(conditions: Vec<Expression>) -> [Statement; 1] {
    [Statement::LetAccepted(Pattern::Local(0), conditions)]
}

impl Signatures<'_> {
    /// `kinematics` without branches.
    pub fn kinematics_in_lane(&self) -> Function<Body> {
        let by_value = [Order::Value, Order::Rate, Order::Acceleration].map(|order| {
            let passed = Passed::ByValue(Type::Own(self.types.inputs.clone()));
            Argument { name: self.arguments.of_inputs(order).to_owned(), passed }
        });
        let [inputs, rates, accelerations] = by_value;
        let returns = Type::Tuple(vec![Type::Own(self.types.kinematics.clone()), Type::Flag]);
        let itself = total("kinematics_in_lane", [inputs, self.branch(), rates, accelerations], returns);
        Function { access: Access::Lane, ..itself }
    }

    /// Points and outputs without branches.
    pub fn quantities_in_lane(&self) -> Function<Body> {
        let pose = Argument { name: self.arguments.pose.clone(), passed: Passed::ByValue(self.pose_type()) };
        let moving = [Order::Rate, Order::Acceleration].map(|order| {
            let passed = Passed::ByValue(self.coordinates_type(order));
            Argument { name: self.arguments.of(order).to_owned(), passed }
        });
        let count = 6 * self.mechanism.points.len() + 3 * self.mechanism.outputs.len();
        let returns = Type::Tuple(vec![Type::List(Box::new(Type::Scalar), count), Type::Flag]);
        let itself = total("quantities_in_lane", [pose].into_iter().chain(moving), returns);
        Function { access: Access::Lane, ..itself }
    }
}
