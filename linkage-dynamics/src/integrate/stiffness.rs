//! The test for stiffness: stability, not accuracy, limits the step.
//!
//! The last stage and the end of a step are at the same time t. The difference d of their states lies mostly along the
//! motions that the method amplifies most, and the difference of their rates is J d, with the Jacobian J of the rate
//! (Hairer and Wanner, *Solving Ordinary Differential Equations II*, section IV.2). They estimate |lambda| by
//! |J d| / |d|, which depends on the units: for `x'' = -k x` and d along x it is k in place of sqrt(k).
//!
//! Here two steps of Arnoldi's method, with one more evaluation, give the dominant eigenvalue of J in the plane of d and
//! J d. This is exact if d lies in a plane that J maps to itself, as that of an oscillation, in any units; the inner
//! product is that of the allowed errors. The equations are stiff if h |lambda| exceeds the boundary of stability and
//! the motion of lambda decays to 1/e within the step: what decays so fast is not in the solution any more. An undamped
//! vibration remains in it, and no method can skip it.

use super::control::Tolerance;
use super::integration::Integration;
use super::system::{ErrorOf, System};
use super::tableau::{self, Method};
use crate::MotionError;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Column, Dim, Real, real};
use nalgebra::ComplexField;

/// The number of tested steps limited by stability after which the equations count as stiff, and the number of others
/// in a row after which the count starts again: those of the codes DOP853 and DOPRI5.
const STIFF_STEPS: u32 = 15;
const OTHERS_IN_A_ROW: u32 = 6;

/// The least decay h |Re lambda| of a stiff motion within a step. Vibrations with a damping ratio below 1/6.1 (Dop853)
/// or 1/3.25 (Dopri5) of the critical one count as a part of the solution.
const DECAY: f64 = 1.0;

/// Below this part of the boundary of stability h |J d| / |d| is taken to show that the step is stable: this saves the
/// evaluation.
const CLEARLY_STABLE: f64 = 0.25;

/// An eigenvalue.
struct Eigenvalue {
    real: f64,
    modulus: f64,
}

impl<S: System, M: Method> Integration<S, M> {
    /// Tests the step just taken, if it is one to be tested.
    ///
    /// # Errors
    /// [`MotionError::Stiff`].
    pub(super) fn test_stiffness(&mut self) -> Result<(), ErrorOf<S>> {
        let every = self.stiffness_every;
        if every == 0 || (self.stiff == 0 && !self.counts.accepted.is_multiple_of(every)) {
            return Ok(());
        }
        let table = const { &M::TABLEAU };
        let (last, stages) = (table.stages.len(), table.stages);
        let ((from, start), (t, end)) = (self.from, self.to);
        let h = t - from;
        let stage = start + tableau::combination(&self.slopes, stages[last - 1].weights) * h;
        let (difference, slope) = (end - stage, self.slopes[table.end]);
        let of_difference = slope - self.slopes[last];
        let tolerance = self.tolerance;
        let length = to_f64(h);
        let least = CLEARLY_STABLE * table.control.stability / length.abs();
        let eigenvalue = dominant((&tolerance, &end), (&difference, &of_difference), least, |change| {
            self.counts.evaluations += 1;
            // If the rate fails there, the step counts as not stiff.
            self.system.rate(t, &(end + change)).ok().map(|there| there - slope)
        });
        let is_stiff = eigenvalue.filter(|eigenvalue| {
            length.abs() * eigenvalue.modulus > table.control.stability && length * eigenvalue.real < -DECAY
        });
        if let Some(Eigenvalue { modulus, .. }) = is_stiff {
            (self.stiff, self.not_stiff) = (self.stiff + 1, 0);
            if self.stiff == STIFF_STEPS {
                return Err(MotionError::Stiff { t: to_f64(from), product: length.abs() * modulus });
            }
        } else {
            self.not_stiff += 1;
            if self.not_stiff == OTHERS_IN_A_ROW {
                self.stiff = 0;
            }
        }
        Ok(())
    }
}

/// The dominant eigenvalue of J in the plane of d and J d; `by_jacobian` computes J times a small change of the state
/// y. `None` if |J d| / |d| is below `least`, if a number is not finite or d is zero.
fn dominant<T: Real, N: Dim>(
    (tolerance, y): (&Tolerance<T, N>, &Column<T, N>),
    (difference, of_difference): (&Column<T, N>, &Column<T, N>),
    least: f64,
    by_jacobian: impl FnOnce(Column<T, N>) -> Option<Column<T, N>>,
) -> Option<Eigenvalue> {
    let inner = |a: &Column<T, N>, b: &Column<T, N>| {
        let part = |v: &Column<T, N>, i: usize| to_f64(v[i]) / tolerance.allowed(i, to_f64(y[i]).abs());
        (0..a.dim().count()).fold(0.0, |sum, i| sum + part(a, i) * part(b, i))
    };
    let norm = |a: &Column<T, N>| ComplexField::sqrt(inner(a, a));
    let size = norm(difference);
    let by_first = *of_difference * real::<T>(size.recip());
    let first = *difference * real::<T>(size.recip());
    let along = inner(&first, &by_first);
    let rest = by_first - first * real::<T>(along);
    let across = norm(&rest);
    let stretch = ComplexField::sqrt(along * along + across * across);
    // The comparisons are false for NaN.
    if !(size > 0.0 && stretch >= least && stretch < f64::INFINITY) {
        return None;
    }
    if across <= to_f64(T::default_epsilon()) * along.abs() {
        return Some(Eigenvalue { real: along, modulus: along.abs() });
    }
    let second = rest * real::<T>(across.recip());
    let by_second = by_jacobian(second * real::<T>(size))? * real::<T>(size.recip());
    // The matrix [along, a; across, b] of J in the plane.
    let [a, b] = [inner(&first, &by_second), inner(&second, &by_second)];
    let (mean, half) = (0.5 * (along + b), 0.5 * (along - b));
    let discriminant = half * half + a * across;
    let eigenvalue = if discriminant < 0.0 {
        Eigenvalue { real: mean, modulus: ComplexField::sqrt(mean * mean - discriminant) }
    } else {
        let root = ComplexField::sqrt(discriminant);
        let value = if mean > 0.0 { mean + root } else { mean - root };
        Eigenvalue { real: value, modulus: value.abs() }
    };
    eigenvalue.modulus.is_finite().then_some(eigenvalue)
}
