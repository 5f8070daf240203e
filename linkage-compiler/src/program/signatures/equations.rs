//! Functions of the equations and of their derivatives, and linear systems in J.

use super::Signatures;
use super::form::{fallible, of_mechanism, total};
use crate::program::expression::Type;
use crate::program::function::{Argument, Body, Function, Passed};
use crate::program::names::Order;

impl Signatures<'_> {
    pub fn residual(&self) -> Function<Body> {
        of_mechanism(total("residual", [self.pose()], column(self.unknowns())))
    }

    pub fn residual_scales(&self) -> Function<Body> {
        of_mechanism(total("residual_scales", [self.pose()], column(self.unknowns())))
    }

    pub fn jacobian_unknowns(&self) -> Function<Body> {
        of_mechanism(total("jacobian_unknowns", [self.pose()], self.matrix(self.unknowns())))
    }

    pub fn jacobian_inputs(&self) -> Function<Body> {
        of_mechanism(total("jacobian_inputs", [self.pose()], self.matrix(self.inputs())))
    }

    pub fn jacobian(&self) -> Function<Body> {
        total("jacobian", [self.pose()], Type::Matrix(self.unknowns(), self.unknowns() + self.inputs()))
    }

    pub fn jacobian_unknowns_scales(&self) -> Function<Body> {
        of_mechanism(total("jacobian_unknowns_scales", [self.pose()], self.matrix(self.unknowns())))
    }

    pub fn jacobian_inputs_scales(&self) -> Function<Body> {
        of_mechanism(total("jacobian_inputs_scales", [self.pose()], self.matrix(self.inputs())))
    }

    pub fn determinant(&self) -> Function<Body> {
        of_mechanism(total("determinant", [self.pose()], Type::Scalar))
    }

    pub fn block_determinants(&self, groups: usize) -> Function<Body> {
        of_mechanism(total("block_determinants", [self.pose()], column(groups)))
    }

    pub fn gamma(&self) -> Function<Body> {
        of_mechanism(total("gamma", [self.pose(), self.coordinates(Order::Rate)], column(self.unknowns())))
    }

    pub fn length_scale(&self) -> Function<Body> {
        of_mechanism(total("length_scale", [self.pose()], Type::Scalar))
    }

    pub fn solve_jacobian(&self) -> Function<Body> {
        let column = column(self.unknowns());
        let right = Argument { name: self.arguments.right.clone(), passed: Passed::ByReference(column.clone()) };
        of_mechanism(fallible("solve_jacobian", [self.pose(), right], column))
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

    /// A row for each unknown, with its dimensions as types.
    fn matrix(&self, columns: usize) -> Type {
        Type::Sized("Matrix", vec![self.unknowns(), columns])
    }
}

/// A column of numbers, with its dimension as a type.
fn column(rows: usize) -> Type {
    Type::Column(Box::new(Type::Scalar), rows)
}
