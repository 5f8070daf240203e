//! A motion by its arc length, through its dead points.

use std::vec::Vec;

use super::MotionEnd;
use super::driven::{Driven, PositionOf};
use super::follow::{AtDeadPoint, Followed, Passed, Step, followed};
use super::options::{RangeOptions, out_of_range};
use crate::continuation::{Direction, Options, Path};
use crate::held::{Held, IntoHeld};
use crate::scalar::arithmetic::*;
use crate::{Name, PathError, PathErrorOf, PositionError};

/// A motion by its arc length: it goes on where the parameter reverses, until it closes or ends.
///
/// The arc length is that of [`PathStep::length`](crate::continuation::PathStep::length), from the lower end of the motion, of
/// a closed motion from the position from which it was followed.
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
///         input theta;
///         unknown phi, psi;
///         loop crank@theta + coupler@phi = ground@0 + rocker@psi;
///     }
/// }
/// use linkage::range_of_motion::{MotionByLength, RangeOptions};
///
/// // No link of this four-bar turns fully: the crank goes to and fro, through both dead points.
/// let m = FourBar::default();
/// let start = m.assemble(0.5, FourBarBranch::new(linkage::Elbow::Left))?.coordinates();
/// let motion = MotionByLength::of(&m, &start, RangeOptions::through_change_points())?;
/// assert!(motion.is_closed());
/// assert_eq!(motion.dead_points().count(), 2);
/// # Ok::<(), linkage::Error>(())
/// ```
pub struct MotionByLength<'a, M: Driven> {
    mechanism: Held<'a, M>,
    options: RangeOptions<M::Scalar>,
    steps: Vec<Step<M>>,
    ends: [MotionEnd<M::Name>; 2],
}

/// A dead point that a motion passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeadPoint<Q, T = f64, N = &'static str> {
    /// The arc length there.
    pub length: T,
    /// The position.
    pub position: Q,
    /// The unknowns of the group that is singular.
    pub group: N,
}

impl<'a, M: Driven> MotionByLength<'a, M> {
    /// Follows the motion through a position near `start` with the same parameter until it closes or ends on both sides.
    ///
    /// # Errors
    /// Those of [`RangeOfMotion::of`](super::RangeOfMotion::of).
    pub fn of<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        start: &M::Coordinates,
        options: RangeOptions<M::Scalar>,
    ) -> Result<Self, PathErrorOf<M>> {
        let mechanism = mechanism.into_held();
        let Followed { options, steps, ends, .. } = followed(&*mechanism, start, options, AtDeadPoint::GoOn)?;
        Ok(Self { mechanism, options, steps, ends })
    }

    /// The mechanism that moves.
    #[must_use]
    pub fn driven(&self) -> &M::Of {
        self.mechanism.driven()
    }

    /// The whole arc length.
    #[must_use]
    pub fn length(&self) -> M::Scalar {
        self.steps.last().map_or_else(M::Scalar::zero, |step| step.length) - self.first_length()
    }

    /// Why the motion ends on both sides; a closed motion has the same twice.
    #[must_use]
    pub fn ends(&self) -> [MotionEnd<M::Name>; 2] {
        self.ends
    }

    /// True if the motion is at its start again after its whole length.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self.ends[1], MotionEnd::Closed { .. })
    }

    /// The dead points in the order of travel.
    pub fn dead_points(&self) -> impl Iterator<Item = DeadPoint<PositionOf<M>, M::Scalar, M::Name>> {
        self.steps.iter().filter_map(|step| match step.passed {
            Some(Passed::DeadPoint(group)) => {
                let position = self.mechanism.position_of(&step.position);
                Some(DeadPoint { length: step.length - self.first_length(), position, group })
            }
            Some(Passed::ChangePoint(_)) | None => None,
        })
    }

    /// The position at an arc length, of a closed motion after whole rounds, too. Lengths are
    /// sums of chords: a part of a step is longer than its share by up to a 24th of the square of the turn in the step, a
    /// 400th at most. The position itself is accurate to rounding error.
    ///
    /// # Errors
    /// [`PositionError::NotFinite`] for a length that is not finite, [`InputError::OutOfRange`](crate::InputError::OutOfRange)
    /// for one beyond the ends, and those of [`Path::advance`].
    pub fn at(&self, length: M::Scalar) -> Result<PositionOf<M>, PathErrorOf<M>> {
        let whole = self.length();
        let within = if self.is_closed() && !(length >= M::Scalar::zero() && length <= whole) {
            length - (length / whole).floor() * whole
        } else {
            length
        };
        if !within.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: self.mechanism.name(),
                quantity: Name::from_static("the arc length"),
            }
            .into());
        }
        if within < M::Scalar::zero() || within > whole {
            return Err(out_of_range(&*self.mechanism, "the arc length", length, [M::Scalar::zero(), whole]));
        }
        let at = within + self.first_length();
        let mechanism = &*self.mechanism;
        let place = self.steps.partition_point(|step| step.length <= at).saturating_sub(1);
        let (Some(step), Some(last)) = (self.steps.get(place), self.steps.last()) else {
            return Err(PathError::NoDirection { mechanism: mechanism.name() });
        };
        // The sum above may be an ulp less than the whole length.
        if within >= whole {
            return Ok(mechanism.position_of(&last.position));
        }
        if step.length >= at {
            return Ok(mechanism.position_of(&step.position));
        }
        // Between its ends a motion is in the ranges; rounding errors of an end are not to stop it.
        let options = Options { joint_ranges: false, ..self.options.path };
        let mut path = Path::with(mechanism, &step.position, Direction::Along(step.rates), options)?;
        Ok(mechanism.position_of(&path.advance_by(at - step.length)?.position))
    }

    fn first_length(&self) -> M::Scalar {
        self.steps.first().map_or_else(M::Scalar::zero, |step| step.length)
    }
}
