//! Position, velocity and acceleration without branches, for loops over many positions.

use super::doc::lines;
use super::expression::{Expression, Pattern, Statement, Type};
use super::function::{Access, Argument, Body, Failure, Function, Kernel, Passed, results};
use super::names::Order;
use super::plan::Plan;
use super::signatures::{Signatures, total};
use crate::model::Request;

impl Plan<'_, '_> {
    /// The formulas of `kinematics`, and those that `full_kinematics` adds. A failed check is flagged, and the lane is
    /// then computed by other functions: `kinematics`, and `motion_of_quantities` on its position.
    ///
    /// A kernel of a lane has the results of the other function, and none of them has a name: names decide where the sign
    /// of a difference is written, and with it the sign of a zero.
    pub(super) fn lanes(&mut self) {
        if self.has_lanes_alone() {
            self.kinematics_alone();
        }
        let has_quantities = self.signatures.has_quantities();
        if has_quantities {
            let kernel = self.quantities_kernel(Failure::Error);
            let is_method = self.reads_parameters(&kernel);
            let values = Expression::List(results(0..kernel.results.len()));
            let doc = lines([
                "Value, rate and acceleration of each point and output, those of `full_kinematics`; not finite where they do not",
                "exist.",
            ]);
            let signature = self.signatures.motion_of_quantities();
            self.add(Function { is_method, ..signature }, doc, Body::of(kernel, values));
        }
        if !self.position.is_closed {
            return;
        }
        let (kernel, conditions) = self.kinematics_kernel(Failure::Flag);
        let value = self.kinematics_of_results(&kernel);
        let is_method = !self.signatures.is_open || self.reads_parameters(&kernel);
        let mut body = flagged(kernel, vec![value], "is_accepted");
        body.before = self.turns_of_branch();
        body.after.push(Statement::LetAccepted(Pattern::bound(0), conditions));
        let doc =
            lines(["`kinematics` without branches; false if `kinematics` takes another way or returns an error."]);
        self.add(Function { is_method, ..self.signatures.kinematics_in_lane() }, doc, body);
        if has_quantities {
            let kernel = self.quantities_kernel(Failure::Flag);
            let is_method = self.reads_parameters(&kernel);
            let values = results(0..kernel.results.len());
            let mut body = flagged(kernel, vec![Expression::List(values)], "is_right");
            body.after.push(Statement::LetPassed(Pattern::bound(0)));
            let doc = lines(["`motion_of_quantities` without branches; false if that takes another way."]);
            self.add(Function { is_method, ..self.signatures.quantities_in_lane() }, doc, body);
        }
    }

    /// True if a lane alone has functions of its own, for positions without the values of user functions.
    fn has_lanes_alone(&self) -> bool {
        self.signatures.requests.contains(&Request::Lanes) && !self.pose.externals.is_empty()
    }

    /// The position for a lane alone, by the body of `assemble`.
    pub(super) fn position_alone(&mut self, body: &Body) {
        if !self.has_lanes_alone() {
            return;
        }
        let signature = match (self.position.is_closed, self.position.turns.is_empty()) {
            (false, _) => self.signatures.assemble_near(),
            (true, true) => self.signatures.assemble(),
            (true, false) => self.signatures.assemble_in_turns(),
        };
        // The values of user functions are the last numbers of a position.
        let (_, numbers) = self.position_steps();
        let mut body = body.clone();
        if let Some(kernel) = &mut body.kernel {
            kernel.external = numbers.len() - self.pose.externals.len()..numbers.len();
        }
        let doc = lines(["`assemble` of a position that need not have the values of user functions."]);
        self.add(Function { name: POSITION_ALONE.to_owned(), access: Access::Cold, ..signature }, doc, body);
    }

    /// `kinematics` for a lane alone: a user function that only points and outputs read need not have a value.
    fn kinematics_alone(&mut self) {
        let names = self.signatures.arguments.clone();
        let from = if self.position.is_closed { &names.inputs } else { &names.guess };
        let mut arguments = vec![Expression::name(from), Expression::name(&names.branch)];
        let mut before = Vec::new();
        if self.position.is_closed && !self.position.turns.is_empty() {
            before = self.turns_of_branch();
            arguments.push(Expression::name(&names.turn).borrowed());
        }
        let mut body = self.by_parts(Expression::own_call(POSITION_ALONE, arguments));
        body.before.splice(0..0, before);
        let doc = lines(["The same by separate calls, which say what is wrong."]);
        let signature = self.signatures.kinematics_by_parts(&self.position);
        self.add(Function { name: BY_PARTS_ALONE.to_owned(), ..signature }, doc, body);
        let mut body = self.kinematics_body(BY_PARTS_ALONE);
        if let Some(kernel) = &mut body.kernel {
            // The values of user functions are the last results of a position.
            let of_pose = kernel.conclusive.start - kernel.conclusive.len();
            kernel.external = of_pose - self.pose.externals.len()..of_pose;
        }
        let doc = lines([
            "`kinematics`, whose position need not have the values of user functions: a quantity that needs one that is not finite",
            "is not finite either.",
        ]);
        let signature = self.signatures.kinematics(&self.position);
        let itself = Function { name: ALONE.to_owned(), access: Access::LaneAlone, ..signature };
        self.add(itself, doc, body);
    }
}

/// The functions for the position of a lane alone, if there are user functions.
const ALONE: &str = "kinematics_alone";
const BY_PARTS_ALONE: &str = "kinematics_alone_by_parts";
const POSITION_ALONE: &str = "assemble_alone";

/// A body that returns these values and the flag.
fn flagged(kernel: Kernel, mut values: Vec<Expression>, flag: &str) -> Body {
    values.push(Expression::Local(0));
    Body { locals: vec![flag.to_owned()], ..Body::of(kernel, Expression::Tuple(values)) }
}

impl Signatures {
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
        let itself = self.motion_of_quantities();
        let returns = Type::Tuple(vec![itself.returns, Type::Flag]);
        Function { name: "quantities_in_lane".to_owned(), access: Access::Lane, returns, ..itself }
    }

    /// Points and outputs with their derivatives, finite or not.
    pub fn motion_of_quantities(&self) -> Function<Body> {
        let pose = Argument { name: self.arguments.pose.clone(), passed: Passed::ByValue(self.pose_type()) };
        let moving = [Order::Rate, Order::Acceleration].map(|order| {
            let passed = Passed::ByValue(self.coordinates_type(order));
            Argument { name: self.arguments.of(order).to_owned(), passed }
        });
        let count = 6 * self.points.len() + 3 * self.outputs.len();
        let returns = Type::List(Box::new(Type::Scalar), count);
        let itself = total("motion_of_quantities", [pose].into_iter().chain(moving), returns);
        Function { access: Access::LaneAlone, ..itself }
    }
}
