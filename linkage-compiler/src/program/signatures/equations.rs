//! Functions of the equations and of their derivatives, and linear systems in J.

use super::Signatures;
use super::form::{fallible, of_mechanism, total};
use crate::program::expression::Type;
use crate::program::function::{Argument, Body, Function, Passed};
use crate::program::names::Order;

impl Signatures {
    pub fn residual(&self) -> Function<Body> {
        of_mechanism(total("residual", [self.pose()], column(self.unknowns.len())))
    }

    pub fn residual_scales(&self) -> Function<Body> {
        of_mechanism(total("residual_scales", [self.pose()], column(self.unknowns.len())))
    }

    pub fn jacobian_unknowns(&self) -> Function<Body> {
        of_mechanism(total("jacobian_unknowns", [self.pose()], self.matrix(self.unknowns.len())))
    }

    pub fn jacobian_inputs(&self) -> Function<Body> {
        of_mechanism(total("jacobian_inputs", [self.pose()], self.matrix(self.inputs.len())))
    }

    pub fn jacobian(&self) -> Function<Body> {
        total("jacobian", [self.pose()], Type::Matrix(self.unknowns.len(), self.unknowns.len() + self.inputs.len()))
    }

    pub fn jacobian_unknowns_scales(&self) -> Function<Body> {
        of_mechanism(total("jacobian_unknowns_scales", [self.pose()], self.matrix(self.unknowns.len())))
    }

    pub fn jacobian_inputs_scales(&self) -> Function<Body> {
        of_mechanism(total("jacobian_inputs_scales", [self.pose()], self.matrix(self.inputs.len())))
    }

    pub fn determinant(&self) -> Function<Body> {
        of_mechanism(total("determinant", [self.pose()], Type::Scalar))
    }

    pub fn block_determinants(&self, groups: usize) -> Function<Body> {
        of_mechanism(total("block_determinants", [self.pose()], column(groups)))
    }

    pub fn gamma(&self) -> Function<Body> {
        of_mechanism(total("gamma", [self.pose(), self.coordinates(Order::Rate)], column(self.unknowns.len())))
    }

    pub fn length_scale(&self) -> Function<Body> {
        of_mechanism(total("length_scale", [self.pose()], Type::Scalar))
    }

    pub fn solve_jacobian(&self) -> Function<Body> {
        let column = column(self.unknowns.len());
        let right = Argument { name: self.arguments.right.clone(), passed: Passed::ByReference(column.clone()) };
        of_mechanism(fallible("solve_jacobian", [self.pose(), right], column))
    }

    pub fn velocity_ratios(&self) -> Function<Body> {
        fallible("velocity_ratios", [self.pose()], Type::Matrix(self.unknowns.len(), self.inputs.len()))
    }

    pub fn ratio_derivatives(&self) -> Function<Body> {
        let of = Type::List(Box::new(Type::Matrix(self.inputs.len(), self.inputs.len())), self.unknowns.len());
        fallible("velocity_ratio_derivatives", [self.pose()], of)
    }

    pub fn sensitivity(&self) -> Function<Body> {
        fallible("sensitivity", [self.pose()], Type::Matrix(self.unknowns.len(), self.parameters.len()))
    }

    /// A row for each unknown, with its dimensions as types.
    fn matrix(&self, columns: usize) -> Type {
        Type::Sized("Matrix", vec![self.unknowns.len(), columns])
    }
}

/// A column of numbers, with its dimension as a type.
fn column(rows: usize) -> Type {
    Type::Column(Box::new(Type::Scalar), rows)
}
