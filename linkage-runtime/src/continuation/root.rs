//! Where a number changes its sign along a step.

use crate::{Real, real};

/// Each second trial at least halves the interval, and 2^-64 of a step no longer moves anything.
const MOST_TRIALS: usize = 128;

/// The place between `low` and `high` where a value changes its sign, to the last place that still differs: by the
/// secant of Illinois, and by halving where that is slow. `None` where `value` has none.
pub(super) fn root<T: Real, E>(
    [mut low, mut high]: [T; 2],
    [mut at_low, mut at_high]: [T; 2],
    smallest: T,
    mut value: impl FnMut(T) -> Result<Option<T>, E>,
) -> Result<Option<T>, E> {
    let half = real::<T>(0.5);
    let mut least = if at_low.abs() < at_high.abs() { (at_low.abs(), low) } else { (at_high.abs(), high) };
    for trial in 0..MOST_TRIALS {
        if (high - low).abs() <= smallest {
            break;
        }
        let secant = low + (high - low) * (at_low / (at_low - at_high));
        let middle = low + (high - low) * half;
        let place = if trial % 3 == 2 || !(secant > low && secant < high) { middle } else { secant };
        if place <= low || place >= high {
            break;
        }
        let Some(here) = value(place)? else { return Ok(None) };
        if here.abs() <= least.0 {
            least = (here.abs(), place);
        }
        if here.is_zero() {
            break;
        }
        // The end that stays counts half, so that the secant leaves it.
        if (here > T::zero()) == (at_low > T::zero()) {
            (low, at_low, at_high) = (place, here, at_high * half);
        } else {
            (high, at_high, at_low) = (place, here, at_low * half);
        }
    }
    Ok(Some(least.1))
}
