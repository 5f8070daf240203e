//! Step-size control: the error relative to the tolerance, the next step, the first step.
//!
//! Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), section II.4, as in their
//! codes DOP853 and DOPRI5. Lengths are `f64`: the derivative parts of dual scalars do not influence them.

use nalgebra::ComplexField;

use super::tableau::{self, Control, Slopes, Tableau};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, InputError, Name, Real};

/// The safety factor of the step-size controller.
const SAFETY: f64 = 0.9;

/// The least relative tolerance, in ulps.
const LEAST_TOLERANCE_ULPS: f64 = 10.0;

/// The allowed local error of component i: `relative` (`scale_i` + |`y_i`|).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        bound(serialize = "T: serde::Serialize", deserialize = "T: serde::Deserialize<'de>, N: Default"),
        try_from = "Written<T, N>"
    )
)]
pub struct Tolerance<T: Real, N: Dim> {
    relative: f64,
    scale: Column<T, N>,
}

/// A tolerance that has been read, not yet checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(bound(deserialize = "T: serde::Deserialize<'de>, N: Default"))]
struct Written<T: Real, N: Dim> {
    relative: f64,
    scale: Column<T, N>,
}

#[cfg(feature = "serde")]
impl<T: Real, N: Dim> TryFrom<Written<T, N>> for Tolerance<T, N> {
    type Error = InputError;

    fn try_from(Written { relative, scale }: Written<T, N>) -> Result<Self, InputError> {
        Self::new(relative, scale)
    }
}

impl<T: Real, N: Dim> Tolerance<T, N> {
    /// Sets the tolerance. `relative` is dimensionless, such as 1e-9. `scale` is a typical value of each component, in
    /// its unit: components much smaller than it may have the error `relative * scale`. For an absolute tolerance,
    /// `scale` = absolute / relative.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if the relative tolerance is below ten ulps or above 1, or a scale is not positive
    /// and finite.
    pub fn new(relative: f64, scale: impl Into<Column<T, N>>) -> Result<Self, InputError> {
        Self::checked(relative, scale.into())
    }

    /// The tolerance, or an error with names of a system.
    pub(crate) fn checked<S: Name>(relative: f64, scale: Column<T, N>) -> Result<Self, InputError<S>> {
        let least = LEAST_TOLERANCE_ULPS * to_f64(T::default_epsilon());
        within("the relative tolerance", relative, least, 1.0)?;
        for &scale in &scale {
            positive("the scale of a component", to_f64(scale))?;
        }
        Ok(Self { relative, scale })
    }

    /// Returns the allowed error of a component with magnitude `size`.
    pub(super) fn allowed(&self, component: usize, size: f64) -> f64 {
        self.relative * (to_f64(self.scale[component]) + size)
    }

    /// The root mean square of the components of a change at `y`, each divided by its allowed error.
    pub(super) fn relative_change(&self, change: &Column<T, N>, y: &Column<T, N>) -> f64 {
        self.norm(change, |i| to_f64(y[i]).abs()) / ComplexField::sqrt(change.dim().count() as f64)
    }

    /// sqrt(sum (`v_i` / allowed)^2), where the allowed error is that of a component of magnitude `size(i)`; safe from
    /// overflow of the squares.
    fn norm(&self, v: &Column<T, N>, size: impl Fn(usize) -> f64) -> f64 {
        let part = |i: usize| to_f64(v[i]) / self.allowed(i, size(i));
        let sum = (0..v.dim().count()).fold(0.0, |sum, i| sum + part(i) * part(i));
        if sum < f64::INFINITY {
            return ComplexField::sqrt(sum);
        }
        let most = (0..v.dim().count()).fold(0.0, |most: f64, i| most.max(part(i).abs()));
        if most == f64::INFINITY {
            return most;
        }
        let sum = (0..v.dim().count()).fold(0.0, |sum, i| sum + (part(i) / most) * (part(i) / most));
        most * ComplexField::sqrt(sum)
    }
}

/// Checks that a setting is between `least` and `most`.
pub(super) fn within<S: Name>(quantity: &'static str, value: f64, least: f64, most: f64) -> Result<(), InputError<S>> {
    if (least..=most).contains(&value) {
        Ok(())
    } else {
        Err(InputError::OutOfRange { of: None, quantity: S::from_static(quantity), value, least, most })
    }
}

/// Checks that a setting is positive and finite.
pub(super) fn positive<S: Name>(quantity: &'static str, value: f64) -> Result<(), InputError<S>> {
    within(quantity, value, f64::MIN_POSITIVE, f64::MAX)
}

/// The error of a step divided by the allowed error: the step is accepted up to 1.
#[inline]
pub(super) fn error<T: Real, N: Dim>(
    tableau: &Tableau,
    tolerance: &Tolerance<T, N>,
    (y, next): (&Column<T, N>, &Column<T, N>),
    slopes: &Slopes<T, N>,
    h: f64,
) -> f64 {
    let size = |i: usize| to_f64(y[i]).abs().max(to_f64(next[i]).abs());
    let [first, second] = tableau.errors.map(|weights| {
        if weights.is_empty() { 0.0 } else { tolerance.norm(&tableau::combination(slopes, weights), size) }
    });
    if first == 0.0 {
        return 0.0;
    }
    if first == f64::INFINITY || second == f64::INFINITY {
        return f64::INFINITY;
    }
    // With the error estimates E5 = first and E3 = second: |h| E, E^2 = E5^2 E5^2 / (E5^2 + E3^2 / 100) / N, rearranged
    // so that squares of small errors do not underflow.
    let ratio = second / first;
    h.abs() * first / ComplexField::sqrt(y.dim().count() as f64 * (1.0 + 0.01 * ratio * ratio))
}

/// The length of the first trial step by the norms of the allowed errors: h = 0.01 |y| / |f|, then h from
/// `h^p max(|f|, |y''|) = 0.01`, where p is the order and `y''` comes from an Euler step of the first length. Time is in
/// units of |y| / |f|. If the rate or the state is zero, the first length is 1e-6 `span`, or less if the state moves by
/// its scale sooner.
#[inline]
pub(super) fn first_length<T: Real, N: Dim, E>(
    order: u32,
    tolerance: &Tolerance<T, N>,
    (y, slope): (&Column<T, N>, &Column<T, N>),
    span: f64,
    euler: impl FnOnce(f64) -> Result<Column<T, N>, E>,
) -> f64 {
    let size = |i: usize| to_f64(y[i]).abs();
    let (speed, distance) = (tolerance.norm(slope, size), tolerance.norm(y, size));
    let is_known = speed * span > 1e-5 && distance > 1e-5;
    let time_to_move_by_scale = (tolerance.relative * speed).recip();
    let time = if is_known {
        distance / speed
    } else if 1e-4 * span > time_to_move_by_scale {
        time_to_move_by_scale
    } else {
        span
    };
    let guess = if is_known || time < span { 0.01 * time } else { 1e-6 * span }.min(span);
    // If the rate fails at the end of the Euler step, the guess is used.
    let Ok(ahead) = euler(guess) else { return guess };
    let curvature = tolerance.norm(&(ahead - *slope), size) / guess;
    let steepest = (curvature * time * time).max(speed * time);
    let (most, root) = (0.01, 1.0 / f64::from(order));
    let length = if steepest <= 1e-15 {
        (1e-6 * time).max(1e-3 * guess)
    } else if steepest < f64::INFINITY {
        time * raised(most / steepest, root)
    } else {
        let [curvature, speed, time] = [curvature, speed, time].map(libm::log);
        libm::exp(time + root * (libm::log(most) - (curvature + 2.0 * time).max(speed + time)))
    };
    // After an overflow the length is 0 or NaN: start from the guess, which rejected steps shorten.
    let length = if length > 0.0 { length } else { guess };
    (100.0 * guess).min(length).min(span)
}

/// A power of a number that is not negative, a few ulps off: faster than that of `libm`, and like it, unlike `powf`, with the
/// same bits on every target.
fn raised(base: f64, exponent: f64) -> f64 {
    libm::exp(exponent * libm::log(base))
}

/// The state of the step-size controller.
#[derive(Debug, Clone, Copy)]
pub(super) struct Controller {
    /// The safety factor of the step-size controller.
    pub(super) safety: f64,
    /// The proposed length, without sign; None before the first step.
    pub(super) length: Option<f64>,
    /// The error of the last accepted step.
    error: f64,
    /// True if the last step was rejected.
    rejected: bool,
}

impl Controller {
    pub(super) fn new() -> Self {
        Self { safety: SAFETY, length: None, error: 1e-4, rejected: false }
    }

    /// Proposes the next length from the error of a step of this length; returns true if the step is accepted.
    #[inline]
    pub(super) fn accepts(&mut self, rule: &Control, error: f64, length: f64) -> bool {
        let power = if rule.exponent == 0.125 {
            // Faster, and correctly rounded.
            ComplexField::sqrt(ComplexField::sqrt(ComplexField::sqrt(error)))
        } else {
            raised(error, rule.exponent)
        };
        let (slowest, fastest) = (1.0 / rule.shrink, 1.0 / rule.grow);
        let accepted = error <= 1.0;
        let next = if accepted {
            let stabilised = if rule.beta == 0.0 { power } else { power / raised(self.error, rule.beta) };
            self.error = error.max(1e-4);
            length / (stabilised / self.safety).min(slowest).max(fastest)
        } else {
            length / (power / self.safety).min(slowest)
        };
        // The step after a rejected one does not grow.
        self.length = Some(if accepted && self.rejected { next.min(length) } else { next });
        self.rejected = !accepted;
        accepted
    }

    /// Proposes a shorter length after a step whose rate failed.
    pub(super) fn failed(&mut self, rule: &Control, length: f64) {
        self.length = Some(length * rule.shrink);
        self.rejected = true;
    }
}
