//! The first zero of a function that may oscillate between two points.
//!
//! [`first_zero`] takes the cubic through values and slopes for the function. Where the function oscillates between two
//! points, that says nothing. So a way is halved until the function is like its cubic: at three places, none at the same share
//! of a period from both ends, it deviates by little of what the cubic deviates from its chord, or by little of its distance
//! from zero. A part of up to two radians of a wave is like its cubic. The values at these places may be near those of the
//! function: they only say where it is divided.

use super::first_zero::{Sample, first_zero};
use crate::{Real, real};

/// The places at which a function is compared with its cubic, in parts of the way. With slopes of any ratio at both ends, the
/// cubic deviates from its chord by a 23rd of the sum of both slopes, measured from that of the chord, at one of them at
/// least: random values do not look like it.
const PLACES: [f64; 3] = [0.2113, 0.4271, 0.7193];

/// The largest deviation from the cubic, in parts of this sum.
const LIKE: f64 = 1.0 / 64.0;

/// A function that is farther from zero than the deviation of its cubic and this number of deviations from it has no zero.
const FAR: f64 = 8.0;

/// The most halvings of a way: 1024 parts, for about 300 periods.
const DEEPEST: u32 = 10;

/// Finds an interval around the first zero between two points, as [`first_zero`] does, of a function that may oscillate.
/// `near` is the function up to small errors, `value` the function itself.
///
/// # Errors
/// Those of `value`.
pub fn first_resolved_zero<T: Real, E>(
    ends: [Sample<T>; 2],
    smallest: T,
    near: impl Fn(T) -> T,
    mut value: impl FnMut(T) -> Result<Sample<T>, E>,
) -> Result<Option<[Sample<T>; 2]>, E> {
    let [mut from, end] = ends;
    let (start, way) = (from.at, end.at - from.at);
    // The part between these two of 2^depth parts.
    let (mut place, mut depth) = (0_u32, 0_u32);
    loop {
        let parts = 2_u32.pow(depth);
        let is_last = place + 1 == parts;
        let to = if is_last { end } else { value(start + way * real(f64::from(place + 1) / f64::from(parts)))? };
        if depth < DEEPEST && !is_like_its_cubic(&[from, to], &near) {
            (place, depth) = (2 * place, depth + 1);
            continue;
        }
        let found = first_zero([from, to], smallest, &mut value)?;
        if found.is_some() || is_last {
            return Ok(found);
        }
        from = to;
        place += 1;
        while place.is_multiple_of(2) {
            (place, depth) = (place / 2, depth - 1);
        }
    }
}

/// True if a function is like its cubic between two samples, or has no zero there.
fn is_like_its_cubic<T: Real>([a, b]: &[Sample<T>; 2], near: &impl Fn(T) -> T) -> bool {
    let (way, rise) = (b.at - a.at, b.value - a.value);
    let [fall, climb] = [a, b].map(|end| if end.slope.is_finite() { end.slope * way } else { rise });
    let size = (fall - rise).abs() + (climb - rise).abs();
    let (mut off, mut least) = (T::zero(), a.value.abs().min(b.value.abs()));
    let mut has_one_sign = a.value * b.value > T::zero();
    for place in PLACES.map(real::<T>) {
        let rest = T::one() - place;
        let cubic =
            a.value + rise * place + (fall - rise) * (place * rest * rest) - (climb - rise) * (place * place * rest);
        let value = near(a.at + way * place);
        off = off.max((value - cubic).abs());
        least = least.min(value.abs());
        has_one_sign = has_one_sign && value * a.value > T::zero();
    }
    // The slopes are differences, with half of the digits.
    let largest = a.value.abs().max(b.value.abs()) + fall.abs() + climb.abs();
    let noise = largest * T::default_epsilon().sqrt();
    off <= size * real(LIKE) + noise || has_one_sign && least > size + off * real(FAR)
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
        let Ok(found) = first_resolved_zero(
            ends.map(sample),
            1e-15,
            |at| function(at)[0],
            |at| {
                count += 1;
                Ok::<_, Infallible>(sample(at))
            },
        );
        (found.map(|found| found.map(|end| end.at)), count)
    }

    /// The first crest of a growing wave that is above 1, for starts and frequencies that meet crests and slopes of all kinds.
    #[test]
    fn crests_of_waves_are_found() {
        for case in 0..80 {
            let (w, start) = (5.0 + 10.0 * f64::from(case), 0.001 * f64::from(case % 37));
            let (level, width) = (0.9, 1.0);
            let room = |x: f64| {
                let (sine, cosine) = (w * x).sin_cos();
                [level - x * sine, -(sine + x * w * cosine)]
            };
            // The first crest that is high enough, by small steps.
            let steps = 20_000;
            let first =
                (0..=steps).map(|step| start + width * f64::from(step) / f64::from(steps)).find(|x| room(*x)[0] < 0.0);
            let (found, _) = search([start, start + width], room);
            match (first, found) {
                (None, None) => {}
                (Some(first), Some([low, high])) => {
                    assert!(
                        low <= first && high >= first - 2.0 * width / f64::from(steps) && high < first + 1.5 / w,
                        "{w} {start}"
                    );
                }
                (first, found) => panic!("{w} {start}: {first:?} {found:?}"),
            }
        }
    }

    /// A smooth function is not divided, nor is a wave that is far from zero.
    #[test]
    fn smooth_functions_are_not_divided() {
        assert_eq!(search([0.0, 0.25], |x| [1.0 - x.sin(), -x.cos()]), (None, 0));
        assert_eq!(search([0.0, 0.25], |x| [x.cos() - 0.9, -x.sin()]), (None, 0));
        assert_eq!(search([0.0, 0.25], |x| [5.0 + 0.001 * (900.0 * x).sin(), 0.9 * (900.0 * x).cos()]), (None, 0));
        // A kink is met by few parts, and a wave without end by all.
        let (found, count) = search([0.0, 1.0], |x| [(x - 0.4).abs() + 0.001, (x - 0.4).signum()]);
        assert!(found.is_none() && count < 60, "{count}");
        let (found, count) = search([0.0, 1.0], |x| [1.5 + (1e7 * x).sin(), 1e7 * (1e7 * x).cos()]);
        assert!(found.is_none() && count < 300_000, "{count}");
    }
}
