//! Positions, velocities and accelerations in double-double, and the errors of results against them.

use linkage_double::DoubleDouble;
use linkage_runtime::derivation::{Derivation, Equation, Formula, FormulaView};
use linkage_runtime::jacobian::Scales;
use linkage_runtime::nalgebra::RealField;
use linkage_runtime::position::newton_step;
use linkage_runtime::{D, Kinematic, Mechanism, PerInput, PerUnknown, PositionError, Real, newton, real};

use super::PriceError;

/// A scalar that is a double-double exactly.
pub(super) trait Exact: Real {
    fn exactly(self) -> DoubleDouble;
}

impl Exact for f32 {
    fn exactly(self) -> DoubleDouble {
        f64::from(self).into()
    }
}

impl Exact for f64 {
    fn exactly(self) -> DoubleDouble {
        self.into()
    }
}

impl Exact for DoubleDouble {
    fn exactly(self) -> Self {
        self
    }
}

/// An input with the unknowns, their velocities and accelerations at `v' = 1` and `v'' = 0`.
pub(super) struct Reference {
    values: [Vec<DoubleDouble>; 3],
    is_angle: &'static [bool],
    /// The scales of the unknowns.
    scales: Vec<f64>,
    /// The scale of the input.
    input_scale: f64,
    /// The last correction of the position.
    pub(super) correction: f64,
}

/// Residuals above this, divided by the sum of the magnitudes of their terms, are those of another mechanism: a
/// position in `f64` has 1e-16, next to a dead point 1e-15.
const OTHER_MECHANISM: f64 = 1e-10;

/// The distance over which an equation in double-double is compared with its derivative: below the resolution of `f64`,
/// 2^-53, and far above that of a double-double, 2^-104.
const TINY: f64 = 1.0 / (1_u128 << 70) as f64;

/// The largest error of that comparison, relative to the largest derivatives: rounding errors are 2^-30 of them, those of a
/// function in `f64` as large as its derivative.
const FEW_DIGITS: f64 = 1e-4;

impl Reference {
    /// Solves for the position next to one in `f64`.
    pub(super) fn at<M, T>(m: &M, twice: &T, q: &M::Coordinates) -> Result<Self, PriceError>
    where
        M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>,
        T: Kinematic<Scalar = DoubleDouble, Name = &'static str, U = M::U, V = D<1>>,
    {
        let input = M::inputs(q)[0];
        let failed = |error: PositionError| PriceError::Reference { input, error };
        let guess = in_scalar::<M, T>(q);
        let pose = twice.pose_at(&guess);
        let residuals = twice.residual(&pose).component_div(&twice.residual_scales(&pose));
        for (equation, residual) in (1..).zip(&residuals) {
            let residual = residual.high().abs();
            if residual > OTHER_MECHANISM {
                return Err(PriceError::OtherParameters { mechanism: M::NAME, equation, residual });
            }
        }
        let found = newton(twice, &guess).map_err(failed)?.coordinates;
        // One more step, whose length is the error of the position before it.
        let q_exact = newton_step(twice, &found).map_err(failed)?;
        let pose = twice.pose_at(&q_exact);
        let rates = twice.velocity(&pose, PerInput::<T>::from([real(1.0)]).into()).map_err(failed)?;
        let none = PerInput::<T>::from([real(0.0)]).into();
        let accelerations = twice.acceleration(&pose, &rates, none).map_err(failed)?;
        let scales = Scales::of(m, &m.pose_at(q)).coordinates;
        let correction = T::unknowns(&q_exact) - T::unknowns(&found);
        let scaled = |numbers: &PerUnknown<T>| {
            let all = numbers.iter().zip(&scales.unknowns).map(|(number, scale)| number.high().abs() / scale);
            all.fold(0.0, f64::max)
        };
        Ok(Self {
            correction: scaled(&correction),
            values: [T::unknowns(&q_exact), T::rate_parts(&rates).0, T::acceleration_parts(&accelerations).0]
                .map(|column| column.as_slice().to_vec()),
            is_angle: M::UNKNOWN_ANGLES,
            scales: scales.unknowns.as_slice().to_vec(),
            input_scale: scales.inputs[0],
        })
    }

    /// The error of a derivative of the unknowns, each divided by its scale: 1 for an angle, for a length that of its
    /// loop. Position: the largest error, of an angle modulo full turns. Velocity: the largest error divided by the largest
    /// entry. Acceleration: divided by the larger of the largest entry and the square of the largest velocity, of which it
    /// consists. Infinite for a result that is not a number.
    pub(super) fn error<X: Exact>(&self, order: usize, found: &[X]) -> f64 {
        let expected = self.values[order].iter().zip(&self.scales).zip(self.is_angle);
        let errors = found.iter().zip(expected).map(|(found, ((expected, scale), is_angle))| {
            let mut error = found.exactly() - *expected;
            if order == 0 && *is_angle {
                let turn = DoubleDouble::two_pi();
                error -= turn * (error.high() / turn.high()).round().into();
            }
            if error.high().is_finite() { error.high().abs() / scale } else { f64::INFINITY }
        });
        let largest = errors.fold(0.0, f64::max);
        let size = |order: usize| {
            let sizes = self.values[order].iter().zip(&self.scales).map(|(value, scale)| value.high().abs() / scale);
            sizes.fold(0.0, f64::max)
        };
        let size = match order {
            0 => return largest,
            1 => size(1),
            _ => size(2).max(size(1) * size(1)),
        };
        // Where nothing moves, the error is relative to the motion of the input.
        largest / if size > 0.0 { size } else { self.input_scale.powi(-(order as i32)) }
    }
}

/// Coordinates in another scalar.
pub(super) fn in_scalar<M, X>(q: &M::Coordinates) -> X::Coordinates
where
    M: Mechanism<Scalar = f64, Name = &'static str>,
    X: Mechanism<U = M::U, V = M::V>,
{
    let (unknowns, inputs) = M::parts(q);
    X::coordinates(unknowns.map(real), inputs.map(real))
}

/// Returns an error if an equation in double-double has fewer digits than that, at a position.
pub(super) fn check_digits<T>(twice: &T, derivation: &Derivation<'static>, q: &T::Coordinates) -> Result<(), PriceError>
where
    T: Kinematic<Scalar = DoubleDouble, Name = &'static str, V = D<1>>,
{
    let pose = twice.pose_at(q);
    let (scales, residual) = (Scales::of(twice, &pose), twice.residual(&pose));
    let (unknowns, inputs) = T::parts(q);
    let (by_unknowns, by_inputs) = (twice.jacobian_unknowns(&pose), twice.jacobian_inputs(&pose));
    let columns = unknowns.iter().enumerate().map(|(place, _)| {
        let step = scales.coordinates.unknowns[place] * real(TINY);
        let mut moved = unknowns;
        moved[place] += step;
        (T::coordinates(moved, inputs), step, by_unknowns.column(place))
    });
    let mut moved = inputs;
    let step = scales.coordinates.inputs[0] * real(TINY);
    moved[0] += step;
    let all = columns.chain([(T::coordinates(unknowns, moved), step, by_inputs.column(0))]);
    for (near, step, column) in all {
        let change = twice.residual(&twice.pose_at(&near)) - residual;
        for (row, (change, derivative)) in change.iter().zip(&column).enumerate() {
            // In the scale of a residual by that of a coordinate, the largest derivative is about 1.
            let error = (*change - *derivative * step).high() / (scales.residuals[row].high() * TINY);
            // False for NaN, too.
            let is_smooth = error.abs() <= FEW_DIGITS;
            if !is_smooth {
                let function = derivation.residual.iter().find_map(user_function);
                let (mechanism, input) = (T::NAME, inputs[0].high());
                return Err(PriceError::FewDigits { mechanism, equation: row + 1, function, input });
            }
        }
    }
    Ok(())
}

/// The first user function in an equation.
fn user_function(equation: &Equation<'static>) -> Option<&'static str> {
    fn within(formula: Formula<'static>) -> Option<&'static str> {
        match formula.view() {
            FormulaView::External(name, ..) => Some(name),
            FormulaView::Sum(terms) => terms.iter().find_map(|(_, term)| within(term)),
            FormulaView::Product(all) | FormulaView::Call(_, all) | FormulaView::AtMost(all) => {
                all.iter().find_map(within)
            }
            FormulaView::Quotient(one, other) | FormulaView::Multiple(one, other) => {
                within(one).or_else(|| within(other))
            }
            FormulaView::Power(of, _) | FormulaView::NonZero(of) | FormulaView::Exists(of) => within(of),
            _ => None,
        }
    }
    within(equation.right).or_else(|| within(equation.left))
}
