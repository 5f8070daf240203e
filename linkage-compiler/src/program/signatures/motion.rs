//! Functions of velocities and accelerations, with the parts of them that functions of scenes call.

use super::Signatures;
use super::form::{fallible, layer, public_inlined, total};
use crate::program::branch::Position;
use crate::program::expression::Type;
use crate::program::function::{Access, Argument, Body, Function, Passed};
use crate::program::names::Order;

impl Signatures {
    pub fn velocity(&self) -> Function<Body> {
        let arguments = [self.pose(), self.inputs_by(Order::Rate)];
        public_inlined(fallible("velocity", arguments, self.coordinates_type(Order::Rate)))
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

    /// W, column by column.
    pub fn ratio_columns(&self) -> Function<Body> {
        layer(fallible("ratio_columns", [self.pose(), self.error_name()], self.columns()))
    }

    fn columns(&self) -> Type {
        Type::List(Box::new(Type::List(Box::new(Type::Scalar), self.unknowns.len())), self.inputs.len())
    }

    pub fn coordinate_rates(&self) -> Function<Body> {
        let ratios = Argument { name: self.arguments.ratios.clone(), passed: Passed::ByReference(self.columns()) };
        let ratios = (!self.is_open).then_some(ratios);
        let arguments = ratios.into_iter().chain([self.input_rates()]);
        let rates = layer(total("coordinate_rates", arguments, self.coordinates_type(Order::Rate)));
        Function { is_method: false, ..rates }
    }

    /// The pose, W, `q'`, and `u''` at `v'' = 0`.
    pub fn reduced_motion(&self) -> Function<Body> {
        let arguments = [self.coordinates(Order::Value), self.input_rates(), self.error_name()];
        let of = Type::ReducedMotion {
            pose: self.types.pose.clone(),
            rates: self.types.rates.clone(),
            unknowns: self.unknowns.len(),
            inputs: self.inputs.len(),
        };
        layer(fallible("reduced_motion", arguments, of))
    }
}
