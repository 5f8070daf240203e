//! Quantities that do not move.
//!
//! The values of a constant quantity differ by rounding errors, and at another input nearby these are others; where
//! it moves, its values there are nearly the same. So it is constant if its values are no farther apart than those at two
//! neighbouring inputs. No derivative is asked, which has rounding errors too, nor a size of the quantity.

use core::cmp::Ordering::Equal;
use std::vec::Vec;

use crate::jacobian::Sample;
use crate::scalar::larger;
use crate::{Real, real};

/// The parts of a motion in which errors have a size each: next to a singular position they are larger.
const PARTS: usize = 12;

/// Values this many times as far apart as two neighbours are not those of a constant.
const FARTHER: f64 = 16.0;

/// A derivative that explains a difference to this part of it.
const EXPLAINED: f64 = 1.0 / 16.0;

/// True if in one of four steps the difference of values is what the derivatives give by the trapezoidal rule: of rounding
/// errors that is so in few.
pub(super) fn moves<T: Real>(samples: &[(T, Sample<T>)]) -> bool {
    let explained = samples.windows(2).filter(|pair| {
        let [(before, from), (after, to)] = [pair[0], pair[1]];
        let (difference, expected) = (after - before, (from.value + to.value) * (to.at - from.at) * real(0.5));
        !difference.is_zero() && (difference - expected).abs() <= difference.abs() * real(EXPLAINED)
    });
    4 * explained.count() >= samples.len()
}

/// The values in a part, and the largest difference of neighbours.
struct Part<T> {
    least: T,
    most: T,
    noise: T,
}

/// True if values in the order of the input, each with that at an input next to it, are those of a constant.
pub(super) fn is_constant<T: Real>(pairs: &[[T; 2]]) -> bool {
    let parts: Vec<Part<T>> = pairs.chunks(pairs.len().div_ceil(PARTS).max(1)).filter_map(Part::of).collect();
    let enough = |noise: T| noise * real(FARTHER);
    let quietest = parts.iter().min_by(|one, other| one.noise.partial_cmp(&other.noise).unwrap_or(Equal));
    quietest.is_some_and(|quietest| {
        parts.iter().all(|part| {
            let middles = (part.least + part.most - quietest.least - quietest.most) * real(0.5);
            part.most - part.least <= enough(part.noise) && middles.abs() <= enough(part.noise + quietest.noise)
        })
    })
}

impl<T: Real> Part<T> {
    fn of(pairs: &[[T; 2]]) -> Option<Self> {
        let &[first, _] = pairs.first()?;
        let all = pairs.iter().flatten();
        let [least, most] = all.fold([first; 2], |[least, most], &value| [least.min(value), most.max(value)]);
        // A value has its own last digit at least.
        let digit = larger(least.abs(), most.abs()) * T::default_epsilon();
        let noise = pairs.iter().fold(digit, |noise, [one, other]| larger(noise, (*one - *other).abs()));
        Some(Self { least, most, noise })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value with an error of some ulps that depends on all digits of the input.
    fn pairs(value: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..360).map(|step| f64::from(step) / 57.0 + 0.1).map(|at| [value(at), value(at + 1e-5)]).collect()
    }

    #[test]
    fn rounding_errors_are_constant() {
        let error = |at: f64| (at * 1e15).sin();
        assert!(is_constant(&pairs(|at| 0.3 + 2e-16 * error(at))));
        assert!(is_constant(&pairs(|at| 1e-17 * error(at))));
        assert!(is_constant(&pairs(|at| 1e-12 * error(at) / at)));
        assert!(is_constant(&pairs(|_| 0.0)) && is_constant(&pairs(|_| -7.0)));
        // Mostly the same, and rarely the next.
        assert!(is_constant(&pairs(|at| if error(at) > 0.99 { 1e-17 } else { 0.0 })));
    }

    #[test]
    fn motions_are_not() {
        let error = |at: f64| (at * 1e15).sin();
        for size in [1.0, 1e-9, 1e-13] {
            assert!(!is_constant(&pairs(|at| size * at.cos() + 1e-16 * error(at))), "{size}");
            // It rests in most of the motion.
            assert!(!is_constant(&pairs(|at| size * (at - 5.0).max(0.0) + 1e-16 * error(at))), "{size}");
        }
        // Slowly, from part to part; and to and fro in a few steps.
        assert!(!is_constant(&pairs(|at| 1.0 + 1e-14 * at + 1e-16 * error(at))));
        assert!(!is_constant(&pairs(|at| 1.0 + 1e-12 * (at * 150.0).sin())));
    }
}
