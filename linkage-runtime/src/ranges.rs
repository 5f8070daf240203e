//! Ranges of coordinates and outputs: the ends of slots, the strokes of cylinders, the stops of doors.
//!
//! A mechanism declares them, as in `unknown s in 0.2..0.9;`. Positions and velocities do not depend on them; motions,
//! limits and circuits end where one is met.

use crate::scalar::{larger, to_f64};
use crate::{InputError, Name, Real, real};

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RangeEnd {
    /// The least value.
    Least,
    /// The largest value.
    Most,
}

impl RangeEnd {
    /// Both ends.
    pub const BOTH: [Self; 2] = [Self::Least, Self::Most];
}

/// A coordinate or an output at a position, with its range. Both ends belong to the range; either may be missing.
///
/// An angle is understood modulo whole turns if these change nothing, and if the range is at most a turn: its value is then
/// the one nearest to the middle. An angle that counts turns, as that of a gear, is taken as it is, and so is one with a
/// longer range or one end only: a motion counts its turns from the start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ranged<T = f64> {
    /// The value.
    pub value: T,
    /// The least value.
    pub least: Option<T>,
    /// The largest value.
    pub most: Option<T>,
    /// True for an angle modulo whole turns.
    pub is_direction: bool,
}

/// A value counts as at an end if it is at most this number of ulps of the end beyond it.
const AT_END_ULPS: f64 = 4.0;

impl<T: Real> Ranged<T> {
    /// The distance from an end, negative beyond it; none without this end.
    #[must_use]
    pub fn room_at(&self, end: RangeEnd) -> Option<T> {
        match end {
            RangeEnd::Least => self.least.map(|least| self.value - least),
            RangeEnd::Most => self.most.map(|most| most - self.value),
        }
    }

    /// The end at this side.
    #[must_use]
    pub fn end(&self, end: RangeEnd) -> Option<T> {
        match end {
            RangeEnd::Least => self.least,
            RangeEnd::Most => self.most,
        }
    }

    /// The value at which programs begin if none is given: the middle of the range, or its end where it has one only; none
    /// without a range.
    #[must_use]
    pub fn first(&self) -> Option<T> {
        match (self.least, self.most) {
            (Some(least), Some(most)) => Some(least * real(0.5) + most * real(0.5)),
            (end, None) | (None, end) => end,
        }
    }

    /// True if the value is in the range, up to a few ulps.
    #[must_use]
    pub fn is_within(&self) -> bool {
        RangeEnd::BOTH.into_iter().all(|end| {
            let (Some(room), Some(limit)) = (self.room_at(end), self.end(end)) else { return true };
            let slack = limit.abs() * T::default_epsilon() * real(AT_END_ULPS);
            room >= -slack
        })
    }

    /// This value next to another along a motion, without a jump by whole turns.
    #[must_use]
    pub(crate) fn following(self, last: T) -> Self {
        let turns = ((last - self.value) / T::two_pi()).round();
        if self.is_direction { Self { value: self.value + T::two_pi() * turns, ..self } } else { self }
    }

    /// Returns the error of a range without room, or of a value outside.
    ///
    /// # Errors
    /// [`InputError::EmptyRange`], [`InputError::OutOfRange`].
    pub(crate) fn check<N: Name>(&self, mechanism: N, name: N) -> Result<(), InputError<N>> {
        self.check_ends(mechanism.clone(), name.clone())?;
        let [least, most] = self.ends();
        let (of, value) = (Some(mechanism), to_f64(self.value));
        let outside = InputError::OutOfRange { of, quantity: name, value, least, most };
        if self.is_within() { Ok(()) } else { Err(outside) }
    }

    /// Returns an error if the range has no room: its ends are numbers, the first less than the second.
    ///
    /// # Errors
    /// [`InputError::EmptyRange`].
    pub(crate) fn check_ends<N: Name>(&self, mechanism: N, name: N) -> Result<(), InputError<N>> {
        let [least, most] = self.ends();
        let are_finite = [self.least, self.most].into_iter().flatten().all(|end| end.is_finite());
        if are_finite && least < most {
            return Ok(());
        }
        Err(InputError::EmptyJointRange { mechanism, of: name, least, most })
    }

    fn ends(&self) -> [f64; 2] {
        [self.least.map_or(f64::NEG_INFINITY, to_f64), self.most.map_or(f64::INFINITY, to_f64)]
    }
}

/// A value with its range.
#[inline]
pub fn ranged<T>(value: T, least: Option<T>, most: Option<T>) -> Ranged<T> {
    Ranged { value, least, most, is_direction: false }
}

/// An angle that counts no turns, with its range, over numbers of any kind: the caller adds turns.
#[inline]
pub fn ranged_modulo_turns<T>(angle: T, least: Option<T>, most: Option<T>) -> Ranged<T> {
    Ranged { value: angle, least, most, is_direction: true }
}

/// An angle that counts no turns, with its range: in the turn nearest to the middle, if the range is at most a turn.
#[inline]
pub fn ranged_direction<T: Real>(angle: T, least: Option<T>, most: Option<T>) -> Ranged<T> {
    match (least, most) {
        (Some(low), Some(high)) if is_of_one_turn(low, high) => {
            Ranged { value: in_range(angle, low, high), least, most, is_direction: true }
        }
        _ => ranged(angle, least, most),
    }
}

/// The angle nearest to the middle of a range that differs from this one by whole turns; the angle itself, if the range is
/// more than a turn.
#[inline]
pub fn in_range<T: Real>(angle: T, least: T, most: T) -> T {
    let off = (least + most) * real(0.5) - angle;
    // No turn is added to an angle at most half a turn away: an end of a whole turn belongs to it.
    if off.abs() > T::pi() && is_of_one_turn(least, most) {
        angle + T::two_pi() * (off / T::two_pi()).round()
    } else {
        angle
    }
}

/// True if a range of an angle is at most a turn, up to a few ulps of its ends.
#[inline]
fn is_of_one_turn<T: Real>(least: T, most: T) -> bool {
    let slack = larger(least.abs(), most.abs()) * T::default_epsilon() * real(AT_END_ULPS);
    // False for an end that is not finite.
    most - least - slack <= T::two_pi()
}

#[cfg(test)]
mod tests {
    use super::*;

    use core::f64::consts::{PI, TAU};

    #[test]
    fn the_turn_nearest_to_the_middle() {
        // Both ends of a whole turn belong to it.
        assert_eq!([0.0, TAU, 3.0].map(|angle| in_range(angle, 0.0, TAU)), [0.0, TAU, 3.0]);
        assert_eq!(in_range(-0.5, 0.0, TAU), TAU - 0.5);
        for turn in [-5.0, 0.0, 3.0] {
            let found = in_range(0.25 + turn * TAU, PI, 1.5 * PI);
            assert!((found - 0.25 - TAU).abs() < 1e-14, "{found}");
        }
        // More than a turn, and ends that are no numbers.
        assert_eq!(in_range(-9.0, 0.0, TAU + 1e-9), -9.0);
        assert_eq!(in_range(-9.0, f64::NAN, 1.0), -9.0);
        assert_eq!(in_range(-9.0, 1.0, f64::INFINITY), -9.0);
        assert!(in_range(f64::NAN, 0.0, 1.0).is_nan());
    }

    #[test]
    fn first_values() {
        let first = |least, most| ranged(9.0, least, most).first();
        assert_eq!([first(Some(-80.0), Some(80.0)), first(Some(1.0), Some(4.0))], [Some(0.0), Some(2.5)]);
        assert_eq!([first(Some(1.0), None), first(None, Some(4.0)), first(None, None)], [Some(1.0), Some(4.0), None]);
        assert_eq!(first(Some(f64::MAX), Some(f64::MAX)), Some(f64::MAX));
    }

    #[test]
    fn values_at_their_ends() {
        let of = |value: f64| ranged(value, Some(0.2), Some(0.9));
        assert!([0.2, 0.5, 0.9, 0.9_f64.next_up(), 0.2_f64.next_down()].iter().all(|value| of(*value).is_within()));
        assert!([0.2 - 1e-15, 0.9 + 1e-15, -0.5, f64::INFINITY, f64::NAN].iter().all(|value| !of(*value).is_within()));
        assert_eq!([of(0.5).room_at(RangeEnd::Least), of(0.5).room_at(RangeEnd::Most)], [Some(0.3), Some(0.4)]);
        assert_eq!(ranged(1.0, None, Some(3.0)).room_at(RangeEnd::Least), None);
        assert!(ranged_direction(7.0, Some(0.0), Some(1.0)).is_within());
        assert!(!ranged(7.0, Some(0.0), Some(1.0)).is_within());
        for (least, most) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let error = ranged(1.0, Some(least), Some(most)).check_ends("m", "s");
            assert!(
                matches!(error, Err(InputError::EmptyJointRange { mechanism: "m", of: "s", .. })),
                "{least} {most}"
            );
        }
    }
}
