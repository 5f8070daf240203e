//! Functions of the equations and of their derivatives, and linear systems in J.

use super::Signatures;
use super::form::{fallible, hidden, total};
use crate::program::expression::Type;
use crate::program::function::{Argument, Body, Function, Passed};

impl Signatures<'_> {
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

    pub fn block_determinants(&self, groups: usize) -> Function<Body> {
        total("block_determinants", [self.pose()], Type::List(Box::new(Type::Scalar), groups))
    }

    pub fn length_scale(&self) -> Function<Body> {
        hidden("length_scale", [self.pose()], Type::Scalar)
    }

    pub fn solve_jacobian(&self) -> Function<Body> {
        let vector = Type::Vector(self.unknowns());
        let right = Argument { name: self.arguments.right.clone(), passed: Passed::ByReference(vector.clone()) };
        fallible("solve_jacobian", [self.pose(), right], vector)
    }

    pub fn velocity_ratios(&self) -> Function<Body> {
        fallible("velocity_ratios", [self.pose()], Type::Matrix(self.unknowns(), self.inputs()))
    }

    pub fn ratio_derivatives(&self) -> Function<Body> {
        let of = Type::List(Box::new(Type::Matrix(self.inputs(), self.inputs())), self.unknowns());
        fallible("velocity_ratio_derivatives", [self.pose()], of)
    }

    pub fn sensitivity(&self) -> Function<Body> {
        fallible("sensitivity", [self.pose()], Type::Matrix(self.unknowns(), self.mechanism.parameters.len()))
    }
}
