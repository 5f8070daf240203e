//! The formulas of a mechanism over numbers of any kind.

use crate::{Column, Dim, Mechanism, Number, Ranged};

/// The formulas of a mechanism without a comparison: over intervals, each result contains the results for all numbers of
/// the intervals.
///
/// `linkage!` implements it for the mechanism over every [`Number`] with `derive intervals;`.
pub trait Formulas: Sized {
    /// The type of lengths and angles.
    type Number: Number;
    /// The number of parameters.
    type P: Dim;
    /// The number of unknowns.
    type U: Dim;
    /// The number of inputs.
    type V: Dim;
    /// The number of quantities: two components of each point, then the outputs.
    type Q: Dim;

    /// The mechanism with these parameters, in declared order.
    fn with_parameters(parameters: Column<Self::Number, Self::P>) -> Self;
    /// Psi, the residual of the loop equations and constraints.
    fn residual(
        &self,
        unknowns: &Column<Self::Number, Self::U>,
        inputs: &Column<Self::Number, Self::V>,
    ) -> Column<Self::Number, Self::U>;
    /// The columns of J, the derivatives of Psi by each unknown.
    fn jacobian_unknowns(
        &self,
        unknowns: &Column<Self::Number, Self::U>,
        inputs: &Column<Self::Number, Self::V>,
    ) -> Column<Column<Self::Number, Self::U>, Self::U>;
    /// The columns of A, the derivatives of Psi by each input.
    fn jacobian_inputs(
        &self,
        unknowns: &Column<Self::Number, Self::U>,
        inputs: &Column<Self::Number, Self::V>,
    ) -> Column<Column<Self::Number, Self::U>, Self::V>;
    /// The quadratic velocity term (Psi_q q')_q q'.
    fn gamma(
        &self,
        unknowns: &Column<Self::Number, Self::U>,
        inputs: &Column<Self::Number, Self::V>,
        unknown_rates: &Column<Self::Number, Self::U>,
        input_rates: &Column<Self::Number, Self::V>,
    ) -> Column<Self::Number, Self::U>;
    /// The coordinates of the points, x and y of each, then the outputs.
    fn quantities(
        &self,
        unknowns: &Column<Self::Number, Self::U>,
        inputs: &Column<Self::Number, Self::V>,
    ) -> Column<Self::Number, Self::Q>;
    /// The value with a range at this place of [`RANGES`](Mechanism::RANGES), with its ends; none beyond the last. An angle
    /// modulo turns is as it is given.
    fn ranged(
        &self,
        _: usize,
        _: &Column<Self::Number, Self::U>,
        _: &Column<Self::Number, Self::V>,
    ) -> Option<Ranged<Self::Number>> {
        None
    }
}

/// A mechanism whose motions can be certified: its formulas exist over all kinds of numbers.
///
/// `linkage!` implements it for the mechanism over `f64` with `derive intervals;`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no formulas over intervals",
    note = "add `derive intervals;` to its mechanism"
)]
pub trait Certifiable: Mechanism<Scalar = f64, Name = &'static str, U: Default, V: Default, G: Default> {
    /// The number of parameters.
    type P: Dim + Default;
    /// The number of quantities: two components of each point, then the outputs.
    type Q: Dim + Default;
    /// The mechanism over another kind of number.
    type Over<N: Number>: Formulas<Number = N, P = Self::P, U = Self::U, V = Self::V, Q = Self::Q>;

    /// The names of the parameters.
    const PARAMETERS: &'static [&'static str];
    /// The names of the quantities: `c_x`, `c_y` for a point `C`, then those of the outputs.
    const QUANTITIES: &'static [&'static str];
    /// The name of the first user function in the equations of each group, in the order of
    /// [`GROUPS`](Mechanism::GROUPS).
    const USER_FUNCTIONS: &'static [Option<&'static str>];

    /// The values of the parameters.
    fn parameters(&self) -> Column<f64, Self::P>;
}
