//! The formulas of a mechanism over numbers of any kind.

use crate::{Column, Dim, Mechanism, Name, Number, Ranged};

/// The formulas of a mechanism without a comparison: over intervals, each result contains the results for all numbers of
/// the intervals.
///
/// `linkage!` implements it for the mechanism over every [`Number`] with `derive intervals;`. [`Certifiable::over`] makes them.
pub trait Formulas: Sized {
    /// The type of lengths and angles.
    type Number: Number;
    /// The number of unknowns.
    type U: Dim;
    /// The number of inputs.
    type V: Dim;
    /// The number of quantities: two components of each point, then the outputs.
    type Q: Dim;

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
    /// The value with a range at this place of [`range_name`](Mechanism::range_name), with its ends; none beyond the last. An angle
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
/// `linkage!` implements it for the mechanism over `f64` with `derive intervals;`. A generic function that is to take mechanisms
/// at run time as well reads names and numbers by the methods of the value.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no formulas over intervals",
    note = "add `derive intervals;` to its mechanism"
)]
pub trait Certifiable: Mechanism<Scalar = f64> + Sized {
    /// The number of parameters.
    type P: Dim;
    /// The number of quantities: two components of each point, then the outputs.
    type Q: Dim;
    /// The mechanism over another kind of number.
    type Over<N: Number>: Formulas<Number = N, U = Self::U, V = Self::V, Q = Self::Q>;

    /// The names of the parameters.
    const PARAMETERS: &'static [&'static str];
    /// The names of the quantities: `c_x`, `c_y` for a point `C`, then those of the outputs.
    const QUANTITIES: &'static [&'static str];
    /// The name of the first user function in the equations of each group, in the order of
    /// [`GROUPS`](Mechanism::GROUPS).
    const USER_FUNCTIONS: &'static [Option<&'static str>];

    /// The name of a parameter, in order; empty beyond the last.
    #[inline]
    fn parameter_name(&self, place: usize) -> Self::Name {
        Name::from_static(Self::PARAMETERS.get(place).copied().unwrap_or_default())
    }
    /// The name of a quantity, in order; empty beyond the last.
    #[inline]
    fn quantity_name(&self, place: usize) -> Self::Name {
        Name::from_static(Self::QUANTITIES.get(place).copied().unwrap_or_default())
    }
    /// The name of the first user function in the equations of a group; none if they have none.
    #[inline]
    fn user_function(&self, group: usize) -> Option<Self::Name> {
        Self::USER_FUNCTIONS.get(group).copied().flatten().map(Name::from_static)
    }
    /// The number of quantities. A mechanism needs a body of it if it is not a constant.
    #[inline]
    fn quantity_count(&self) -> Self::Q {
        Dim::least()
    }

    /// The values of the parameters.
    fn parameters(&self) -> Column<f64, Self::P>;
    /// This mechanism with other values of its parameters, in declared order.
    fn with(&self, parameters: Column<f64, Self::P>) -> Self;
    /// The formulas of this mechanism over another kind of number, with these parameters in declared order.
    fn over<N: Number>(&self, parameters: Column<N, Self::P>) -> Self::Over<N>;
}
