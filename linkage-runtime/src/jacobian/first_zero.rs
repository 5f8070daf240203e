//! The first zero of a smooth function between two points, from its values and slopes.
//!
//! Signs at two points say nothing of what lies between them: zeros that come in pairs do not show. The slopes at both
//! ends give the cubic of the function there; from its shape an interval has no zero or one, or it is divided. So a
//! function that deviates from its cubic by less than a few times what the cubic deviates from its chord has no zero
//! missed; the shorter the interval, the less it deviates.

use crate::{Real, real};

/// A function at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<T> {
    /// The point.
    pub at: T,
    /// The value there.
    pub value: T,
    /// The derivative there; NaN if it is unknown: then that of the chord is taken.
    pub slope: T,
}

/// A cubic is monotonic if its slopes at both ends are between 0 and 3 times that of the chord (F. N. Fritsch and R. E.
/// Carlson, "Monotone Piecewise Cubic Interpolation", SIAM J. Numer. Anal. 17, 1980); a function near it is within these.
const MONOTONIC: [f64; 2] = [0.2, 2.5];

/// A function bends to one side if the second derivatives of its cubic at both ends do, and differ by at most this factor.
const ONE_BEND: f64 = 4.0;

/// A division is at least this far from both ends, as a fraction of the interval.
const MARGIN: f64 = 0.1;

/// The most evaluations, of a function whose slopes are not those of its values.
const MOST_EVALUATIONS: usize = 256;

/// The deepest division: 2^-60 of the interval.
const DEEPEST: usize = 60;

/// The settings of a search, and its evaluations so far.
struct Search<F, T> {
    value: F,
    /// Below this a value between the ends has no sign.
    noise: T,
    /// An interval shorter than this is not divided.
    smallest: T,
    evaluations: usize,
}

/// Finds an interval around the first zero between two points, at which the function changes its sign and near which it
/// is monotonic; `Ok(None)` if there is none. A zero at the first point itself is none, a change of sign at the second is
/// one, and at a first point with value and slope zero the sign is that of the second. `value` evaluates the function
/// between them, and is not divided below `smallest`.
///
/// # Errors
/// Those of `value`.
pub fn first_zero<T: Real, E>(
    ends: [Sample<T>; 2],
    smallest: T,
    value: impl FnMut(T) -> Result<Sample<T>, E>,
) -> Result<Option<[Sample<T>; 2]>, E> {
    let [a, b] = ends;
    let first = [a.value, a.slope, b.value].into_iter().find(|part| !part.is_zero()).unwrap_or(a.value);
    let sign = if first > T::zero() { T::one() } else { -T::one() };
    // The comparison is false for NaN.
    let has_sign = first * sign > T::zero();
    if !has_sign {
        return Ok(None);
    }
    let size = a.value.abs().max(b.value.abs());
    let noise = size * T::default_epsilon() * real(4.0);
    Search { value, noise, smallest, evaluations: 0 }.within(ends, sign, DEEPEST)
}

/// The cubic through two samples, in terms of the fraction of the interval, times the sign of the function at the first.
struct Cubic<T> {
    values: [T; 2],
    slopes: [T; 2],
    /// The second derivatives at both ends.
    bends: [T; 2],
    rise: T,
}

impl<T: Real> Cubic<T> {
    fn new([a, b]: &[Sample<T>; 2], sign: T) -> Self {
        let length = (b.at - a.at) * sign;
        let values = [a.value * sign, b.value * sign];
        let rise = values[1] - values[0];
        let slopes = [a, b].map(|end| if end.slope.is_finite() { end.slope * length } else { rise });
        let [two, four, six] = [2.0, 4.0, 6.0].map(real::<T>);
        let bends = [six * rise - four * slopes[0] - two * slopes[1], two * slopes[0] + four * slopes[1] - six * rise];
        Self { values, slopes, bends, rise }
    }

    fn is_monotonic(&self) -> bool {
        let [least, most] = MONOTONIC.map(real::<T>);
        self.slopes.iter().all(|&slope| {
            let share = slope / self.rise;
            share >= least && share <= most
        })
    }

    fn bends_to(&self, sign: T) -> bool {
        let [start, end] = self.bends.map(|bend| bend * sign);
        start > T::zero() && end > T::zero() && start <= end * real(ONE_BEND) && end <= start * real(ONE_BEND)
    }

    /// True if the function, positive at both ends, is positive between them.
    fn is_positive(&self) -> bool {
        let deviation = self.slopes.iter().fold(T::zero(), |sum, &slope| sum + (slope - self.rise).abs());
        let [start, end] = self.values;
        // The cubic deviates from its chord by at most 4/27 of this sum.
        if start.min(end) >= deviation || self.is_monotonic() || self.bends_to(-T::one()) {
            return true;
        }
        // Not below its tangents, which meet here.
        let [fall, climb] = self.slopes;
        let place = (self.rise - climb) / (fall - climb);
        self.bends_to(T::one()) && start + fall * place >= T::zero()
    }

    /// The place of the minimum of a cubic that bends upwards, else the middle.
    fn division(&self) -> T {
        let [start, end] = self.bends;
        let discriminant = start * start - self.slopes[0] * (end - start) * real(2.0);
        let place = -(self.slopes[0] + self.slopes[0]) / (start + discriminant.max(T::zero()).sqrt());
        let margin = real::<T>(MARGIN);
        if self.bends_to(T::one()) { place.max(margin).min(T::one() - margin) } else { real(0.5) }
    }
}

impl<T, F, E> Search<F, T>
where
    T: Real,
    F: FnMut(T) -> Result<Sample<T>, E>,
{
    /// The first zero in an interval at whose start, or just after it, the function has this sign.
    fn within(&mut self, ends: [Sample<T>; 2], sign: T, depth: usize) -> Result<Option<[Sample<T>; 2]>, E> {
        let [a, b] = ends;
        let cubic = Cubic::new(&ends, sign);
        let end = cubic.values[1];
        let changes = end < T::zero() || (end.is_zero() && cubic.slopes[1] < T::zero());
        if if changes { cubic.is_monotonic() } else { cubic.is_positive() } {
            return Ok(changes.then_some(ends));
        }
        let is_short = (b.at - a.at).abs() <= self.smallest || depth == 0 || self.evaluations == MOST_EVALUATIONS;
        if is_short {
            // A zero at the start itself is none.
            return Ok((changes && !a.value.is_zero()).then_some(ends));
        }
        self.evaluations += 1;
        let mut middle = (self.value)(a.at + (b.at - a.at) * cubic.division())?;
        if middle.value.abs() <= self.noise {
            middle.value = self.noise * sign;
        }
        let first = self.within([a, middle], sign, depth - 1)?;
        if first.is_some() {
            return Ok(first);
        }
        // Where the first value is zero, the sign of its slope may be that of a rounding error.
        let sign = if middle.value > T::zero() { T::one() } else { -T::one() };
        self.within([middle, b], sign, depth - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::convert::Infallible;

    fn search(ends: [f64; 2], function: impl Fn(f64) -> [f64; 2]) -> (Option<[f64; 2]>, usize) {
        let mut count = 0;
        let sample = |at: f64| {
            let [value, slope] = function(at);
            Sample { at, value, slope }
        };
        let found = first_zero(ends.map(sample), 1e-15, |at| {
            count += 1;
            Ok::<_, Infallible>(sample(at))
        });
        let Ok(found) = found;
        (found.map(|found| found.map(|end| end.at)), count)
    }

    /// (x - a)^2 - e^2 has two zeros; the interval found contains the first only.
    #[test]
    fn pairs_of_zeros() {
        for (place, half) in [0.1, 0.37, 0.5, 0.83].into_iter().flat_map(|a| [3e-1, 1e-2, 1e-4, 1e-6].map(|e| (a, e))) {
            let function = |x: f64| [(x - place).powi(2) - half * half, 2.0 * (x - place)];
            let (found, count) = search([-0.5, 1.5], function);
            let [low, high] = found.unwrap();
            let zero = place - half;
            // A value within its rounding error counts as one before the zero.
            assert!(low < zero + 1e-9 * half && high >= zero && high < place + half, "{place} {half} {low} {high}");
            assert!(count < 40, "{count}");
            // Only near ones do not reach zero.
            let above = |x: f64| [(x - place).powi(2) + half * half, 2.0 * (x - place)];
            let (found, count) = search([-0.5, 1.5], above);
            assert!(found.is_none() && count < 40, "{count}");
        }
    }

    /// A wave has its first zero at pi / w, also from its zero at the start, and none in a part without one.
    #[test]
    fn waves() {
        for w in [1.0, 5.0, 20.0] {
            let function = |x: f64| [(w * x).sin(), w * (w * x).cos()];
            let (found, count) = search([0.0, 1.0], function);
            assert_eq!(found.is_some(), w > 3.2);
            if let Some([low, high]) = found {
                let zero = core::f64::consts::PI / w;
                assert!(low < zero && high >= zero && high < 2.0 * zero, "{w}: {low} {high}");
            }
            assert!(count < 40, "{w}: {count}");
        }
        assert_eq!(search([0.1, 3.1], |x| [x.sin(), x.cos()]).0, None);
        // The end itself is a zero, the start is none.
        let (found, _) = search([-1.0, 0.0], |x| [x, 1.0]);
        assert_eq!(found, Some([-1.0, 0.0]));
        assert_eq!(search([0.0, 1.0], |x| [x, 1.0]).0, None);
    }

    /// A double zero, unknown slopes and wrong ones.
    #[test]
    fn zeros_without_a_change_of_sign() {
        let (found, count) = search([-1.0, 1.5], |x| [x * x, 2.0 * x]);
        assert!(found.is_none() && count <= 80, "{count}");
        assert_eq!(search([-1.0, 1.5], |x| [x * x + 0.1, f64::NAN]), (None, 0));
        assert_eq!(search([-1.0, 1.5], |x| [x, f64::NAN]), (Some([-1.0, 1.5]), 0));
        let (found, count) = search([-1.0, 1.5], |x| [x * x + 0.1, 9.0]);
        assert!(found.is_none() && count <= MOST_EVALUATIONS, "{count}");
        let (found, count) = search([-1.0, 1.5], |x| [x, -1.0]);
        assert!(found.is_some() && count <= MOST_EVALUATIONS, "{count}");
        assert_eq!(search([0.0, 1.0], |_| [0.0, 0.0]).0, None);
    }
}
