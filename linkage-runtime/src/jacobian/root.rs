//! Root finding between two points.

use crate::{Real, real};

/// An interval in which a value falls through zero, by the ITP method (I. F. D. Oliveira and R. H. C. Takahashi, "An
/// Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality", ACM Trans. Math. Softw. 47,
/// 2020), which takes at most one evaluation more than bisection.
pub struct Bracket<T> {
    low: T,
    high: T,
    /// The values at `low` and `high`.
    above: T,
    below: T,
    width: T,
    /// Half the width at which the search ends.
    margin: T,
    /// `margin` 2^(evaluations allowed)
    radius: T,
}

impl<T: Real> Bracket<T> {
    /// The interval from `low` to `high` with the values there, to be narrowed to the width `enough`.
    pub fn new([low, high]: [T; 2], [above, below]: [T; 2], enough: T) -> Self {
        let (width, margin) = (high - low, enough * real(0.5));
        let mut radius = margin;
        while radius < width {
            radius += radius;
        }
        Self { low, high, above, below, width, margin, radius }
    }

    /// The end at which the value is not positive.
    pub fn high(&self) -> T {
        self.high
    }

    /// The point to evaluate next; `None` if the interval is narrow enough.
    pub fn next_point(&self) -> Option<T> {
        let Self { low, high, above, below, width, margin, radius } = *self;
        let (length, half) = (high - low, real::<T>(0.5));
        if length <= margin + margin {
            return None;
        }
        let middle = (low + high) * half;
        let place = if above > T::zero() && below <= T::zero() {
            // An overflow leaves the middle.
            let straight = (above * high - below * low) / (above - below);
            let side = if middle >= straight { T::one() } else { -T::one() };
            let shift = real::<T>(0.2) / width * length * length;
            let truncated = if shift <= (middle - straight).abs() { straight + side * shift } else { middle };
            let room = radius - length * half;
            if (truncated - middle).abs() <= room { truncated } else { middle - side * room }
        } else {
            // At the start of a motion a rounding error of the value may contradict the sign that it has a little later.
            middle
        };
        // The point stays at least `margin` away from both ends.
        let place = place.max(low + margin).min(high - margin);
        (place > low && place < high).then_some(place)
    }

    /// Narrows the interval by the value at a point.
    pub fn narrow(&mut self, place: T, value: T) {
        if value > T::zero() {
            (self.low, self.above) = (place, value);
        } else {
            (self.high, self.below) = (place, value);
        }
        self.radius *= real(0.5);
    }
}

/// Finds the point between `low` and `high` at which a value changes its sign, to within the distance `enough`: of the
/// points evaluated, the one with the value nearest to zero. `None` if `value` returns `None`.
///
/// # Errors
/// Those of `value`.
pub fn root<T: Real, E>(
    [low, high]: [T; 2],
    [at_low, at_high]: [T; 2],
    enough: T,
    mut value: impl FnMut(T) -> Result<Option<T>, E>,
) -> Result<Option<T>, E> {
    let sign = if at_low > T::zero() { T::one() } else { -T::one() };
    let (above, below) = (at_low * sign, at_high * sign);
    let mut least = if above.abs() < below.abs() { (above.abs(), low) } else { (below.abs(), high) };
    let enough = if enough > T::zero() { enough } else { (high - low) * T::default_epsilon() };
    let mut bracket = Bracket::new([low, high], [above, below], enough);
    while let Some(place) = bracket.next_point() {
        let Some(here) = value(place)? else { return Ok(None) };
        if here.abs() <= least.0 {
            least = (here.abs(), place);
        }
        if here.is_zero() {
            break;
        }
        bracket.narrow(place, here * sign);
    }
    Ok(Some(least.1))
}

/// Finds the point where a positive value becomes zero or negative, to within the distance `enough`: the end of the
/// last interval, or the point at which `value` returns `None`.
///
/// # Errors
/// Those of `value`.
pub fn first_not_positive<T: Real, E>(
    ends: [T; 2],
    values: [T; 2],
    enough: T,
    mut value: impl FnMut(T) -> Result<Option<T>, E>,
) -> Result<T, E> {
    let mut bracket = Bracket::new(ends, values, enough);
    while let Some(place) = bracket.next_point() {
        let Some(here) = value(place)? else { return Ok(place) };
        bracket.narrow(place, here);
    }
    Ok(bracket.high())
}
