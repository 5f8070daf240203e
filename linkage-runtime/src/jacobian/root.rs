//! Root finding between two points.

use crate::{Real, real};

/// Finds the point between `low` and `high` at which a value changes its sign, to within the distance `enough`: of the
/// points evaluated, the one with the value nearest to zero. It uses the ITP method (I. F. D. Oliveira and R. H. C.
/// Takahashi, "An Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality", ACM Trans.
/// Math. Softw. 47, 2020), which takes at most one evaluation more than bisection. `None` if `value` returns `None`.
///
/// # Errors
/// Those of `value`.
pub fn root<T: Real, E>(
    [mut low, mut high]: [T; 2],
    [at_low, at_high]: [T; 2],
    enough: T,
    mut value: impl FnMut(T) -> Result<Option<T>, E>,
) -> Result<Option<T>, E> {
    let half = real::<T>(0.5);
    let sign = if at_low > T::zero() { T::one() } else { -T::one() };
    let (mut above, mut below) = (at_low * sign, at_high * sign);
    let mut least = if above.abs() < below.abs() { (above.abs(), low) } else { (below.abs(), high) };
    let width = high - low;
    let enough = if enough > T::zero() { enough } else { width * T::default_epsilon() };
    let margin = enough * half;
    // margin 2^(evaluations allowed)
    let mut radius = margin;
    while radius < width {
        radius += radius;
    }
    while high - low > enough {
        let middle = low + (high - low) * half;
        let straight = low + (high - low) * (above / (above - below));
        let side = if middle >= straight { T::one() } else { -T::one() };
        let shift = (high - low) / width * (high - low) * real(0.2);
        let truncated = if shift <= (middle - straight).abs() { straight + side * shift } else { middle };
        let room = radius - (high - low) * half;
        let place = if (truncated - middle).abs() <= room { truncated } else { middle - side * room };
        // The point stays at least `margin` away from both ends.
        let place = place.max(low + margin).min(high - margin);
        if place <= low || place >= high {
            break;
        }
        let Some(here) = value(place)? else { return Ok(None) };
        let here = here * sign;
        if here.abs() <= least.0 {
            least = (here.abs(), place);
        }
        if here.is_zero() {
            break;
        }
        if here > T::zero() {
            (low, above) = (place, here);
        } else {
            (high, below) = (place, here);
        }
        radius *= half;
    }
    Ok(Some(least.1))
}
