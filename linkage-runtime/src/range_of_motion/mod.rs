//! One motion over a range of its input: the positions that are connected by motion, each found by its input.
//!
//! A branch of [`assemble`](crate::Assembly::assemble) is a side on which joints lie, not a motion: at a change point the
//! motion goes on, and the branch may jump to a mirrored position. A [`RangeOfMotion`] is followed by a [`Path`] in both
//! directions from a position until it ends, and keeps the steps. A position between two steps is on the arc that the path
//! has checked: between regular steps of one branch it has its closed form, elsewhere it is found by one more step. No jump
//! lies between two positions of one range.
//!
//! ```
//! linkage::linkage! {
//!     pub mechanism Tilted {
//!         param a = 2, b = 5, tilt = 5deg;
//!         input theta;
//!         unknown phi, psi;
//!         loop a@theta + b@phi = b@tilt + a@psi;
//!     }
//! }
//! use linkage::continuation::{AtChangePoint, Options};
//! use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
//!
//! let m = Tilted::default();
//! let start = TiltedCoordinates { theta: 0.5, phi: m.tilt, psi: 0.5 };
//! // The links are in line at 5 and at 185 degrees: the motion ends there, since others cross it.
//! let range = RangeOfMotion::of(&m, &start, RangeOptions::default())?;
//! assert!(range.ends().iter().all(|end| matches!(end, MotionEnd::ChangePoint { .. })));
//! // Through both change points the cranks stay parallel.
//! let path = Options { at_change_point: AtChangePoint::Keep, ..Options::default() };
//! let range = RangeOfMotion::of(&m, &start, RangeOptions { path, ..RangeOptions::default() })?;
//! assert_eq!((range.ends()[1], range.crossings().len()), (MotionEnd::Closed { turns: 1 }, 2));
//! for degrees in 0..720 {
//!     let theta = f64::from(degrees).to_radians();
//!     assert!((range.at(theta)?.psi - theta).abs() < 1e-14);
//! }
//! # Ok::<(), linkage::Error>(())
//! ```

mod between;
mod by_length;
mod chosen;
mod crossed;
mod driven;
mod end;
mod follow;
mod motion;
mod options;

use std::vec::Vec;

pub use by_length::{DeadPoint, MotionByLength};
pub use driven::Driven;
pub use end::MotionEnd;
pub use options::RangeOptions;

use crate::continuation::{Direction, Groups, Options, Path};
use crate::held::{Held, IntoHeld};
use crate::jacobian::ulp::{EQUAL_ULPS, nearly_zero};
use crate::position::newton;
use crate::same_position::SamePosition;
use crate::scalar::arithmetic::*;
use crate::scalar::{larger, to_f64};
use crate::{
    Assembly, BorrowedName, Kinematic, Mechanism, Name, PathError, PathErrorOf, PerInput, PositionError, Real, real,
};
use driven::{PositionOf, same_inputs};
use follow::{AtDeadPoint, Followed, Passed, Step, backwards, followed};
use options::out_of_range;

/// A motion of a mechanism by one parameter, its input or that of [`Along`](crate::continuation::Along), between the ends of
/// the parameter.
pub struct RangeOfMotion<'a, M: Mechanism> {
    mechanism: Held<'a, M>,
    options: RangeOptions<M::Scalar>,
    same: SamePosition<M>,
    /// The ends of the steps, in the order of their inputs; of a closed motion the last is the first again.
    steps: Vec<Step<M>>,
    ends: [MotionEnd<M::Name>; 2],
    /// True if a whole turn of the parameter changes no position, as it does with gears.
    repeats: bool,
}

/// A change point that a motion passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<Q, T = f64, N: BorrowedName = &'static str> {
    /// The input, or the parameter.
    pub input: T,
    /// The position.
    pub position: Q,
    /// The groups that are singular there.
    pub groups: Groups<N>,
}

/// A position at which a motion passes another without meeting it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearMiss<Q, T = f64> {
    /// The input, or the parameter.
    pub input: T,
    /// The position, to the length of a step of the path, which is short there.
    pub position: Q,
    /// The smallest pivot of the Jacobian [J A] divided by the largest: about the distance between the motions, angles in
    /// radians and lengths divided by those of their loops.
    pub regularity: T,
}

/// A motion with a smaller regularity than this at a step passes near another.
const NEAR: f64 = 1e-2;

impl<'a, M> RangeOfMotion<'a, M>
where
    M: Driven,
{
    /// Follows the motion through a position near `start` with the same input until it ends on both sides.
    ///
    /// # Errors
    /// [`PathError::NoDirection`] or [`PathError::ChangePoint`] if the start is a dead point or a change point,
    /// [`PathError::TooManySteps`], and other errors of [`Path::with`] and [`Path::advance`].
    pub fn of<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        start: &M::Coordinates,
        options: RangeOptions<M::Scalar>,
    ) -> Result<Self, PathErrorOf<M>> {
        let mechanism = mechanism.into_held();
        let followed = followed(&*mechanism, start, options, AtDeadPoint::End)?;
        Ok(Self::followed(mechanism, start, followed))
    }

    fn followed(mechanism: Held<'a, M>, start: &M::Coordinates, followed: Followed<M>) -> Self {
        let Followed { options, same, steps, ends } = followed;
        let repeats = options.path.range.is_none() && repeats(&*mechanism, start);
        Self { mechanism, options, same, steps, ends, repeats }
    }

    /// The steps of the motion without its mechanism.
    fn into_followed(self) -> Followed<M> {
        let Self { options, same, steps, ends, .. } = self;
        Followed { options, same, steps, ends }
    }

    /// The mechanism that moves.
    #[must_use]
    pub fn driven(&self) -> &M::Of {
        self.mechanism().driven()
    }

    /// The mechanism with the parameter as its input.
    #[must_use]
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The least and the largest input of the steps; a closed motion goes on beyond.
    #[must_use]
    pub fn inputs(&self) -> [M::Scalar; 2] {
        [self.steps.first(), self.steps.last()].map(|step| step.map_or_else(M::Scalar::zero, |step| step.input()))
    }

    /// Why the motion ends at the least and at the largest input; a closed motion has the same twice.
    #[must_use]
    pub fn ends(&self) -> [MotionEnd<M::Name>; 2] {
        self.ends
    }

    /// True if the motion has positions at all inputs and repeats them.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self.ends[1], MotionEnd::Closed { .. })
    }

    /// The change points that the motion passes, in the order of the input.
    pub fn crossings(&self) -> impl ExactSizeIterator<Item = Crossing<PositionOf<M>, M::Scalar, M::Name>> {
        let crossings = self.steps.iter().filter_map(|step| match step.passed {
            Some(Passed::ChangePoint(groups)) => {
                Some(Crossing { input: step.input(), position: self.position_of(step), groups })
            }
            Some(Passed::DeadPoint(_)) | None => None,
        });
        crossings.collect::<Vec<_>>().into_iter()
    }

    /// The positions at which the motion passes nearest to others that it does not meet, in the order of the input.
    pub fn near_misses(&self) -> impl Iterator<Item = NearMiss<PositionOf<M>, M::Scalar>> {
        self.steps.windows(3).filter_map(|three| match three {
            [before, here, after]
                if here.passed.is_none()
                    && here.regularity < real(NEAR)
                    && here.regularity <= before.regularity
                    && here.regularity < after.regularity =>
            {
                Some(NearMiss { input: here.input(), position: self.position_of(here), regularity: here.regularity })
            }
            _ => None,
        })
    }

    /// The position at an input. Coordinates are continuous along the motion: angles count turns. The angle of a motion of at
    /// most a turn that ends may be within its range after whole turns, unless these change positions, as with gears. A motion
    /// of more than a turn has other positions a turn later: its inputs are those at which it has been followed.
    ///
    /// # Errors
    /// If the motion ends before, the reason: [`PathError::DeadPoint`], [`PathError::ChangePoint`], or
    /// [`InputError::OutOfRange`](crate::InputError::OutOfRange) for the end of its range; [`PositionError::NotFinite`] for an
    /// input that is not finite.
    pub fn at(&self, input: M::Scalar) -> Result<PositionOf<M>, PathErrorOf<M>> {
        self.near(input).map(|(q, _)| self.mechanism().position_of(&q))
    }

    /// True if the motion passes a position, up to the error of a position next to a change point.
    ///
    /// # Errors
    /// Those of [`at`](Self::at) for the input of the position.
    pub fn has(&self, position: &M::Coordinates) -> Result<bool, PathErrorOf<M>> {
        let (near, _) = self.near(M::inputs(position)[0])?;
        Ok(self.same.are_near(&near, position))
    }

    fn position_of(&self, step: &Step<M>) -> PositionOf<M> {
        self.mechanism().position_of(&step.position)
    }

    /// The place of an input among the steps: the input within the steps, the cycles of a closed motion before it, and the
    /// index of the step before it.
    fn place(&self, input: M::Scalar) -> Result<(M::Scalar, M::Scalar, usize), PathErrorOf<M>> {
        if !input.is_finite() {
            return Err(PositionError::NotFinite {
                mechanism: self.mechanism.name(),
                quantity: Name::from_static("the input"),
            }
            .into());
        }
        let [first, last] = self.inputs();
        let (within, cycles) = if self.is_closed() {
            let cycles = ((input - first) / (last - first)).floor();
            (input - (last - first) * cycles, cycles)
        } else if self.repeats && is_of_one_turn(last - first) {
            let turn = M::Scalar::two_pi();
            let lowest = input - turn * ((input - first) / turn).floor();
            let is_within = |input: &M::Scalar| {
                let nearest = input.min(last).max(first);
                is_rounding_error(self.mechanism(), *input - nearest, nearest)
            };
            ([input, lowest, lowest - turn].into_iter().find(is_within).unwrap_or(lowest), M::Scalar::zero())
        } else {
            (input, M::Scalar::zero())
        };
        // An end that is known from elsewhere may differ in its last digits; so may a whole number of cycles.
        let nearest = within.min(last).max(first);
        let within = if is_rounding_error(self.mechanism(), within - nearest, nearest) { nearest } else { within };
        let outside = |end: MotionEnd<M::Name>, at: M::Scalar| Err(self.outside(end, input, at));
        if within < first {
            return outside(self.ends[0], first);
        }
        if within > last {
            return outside(self.ends[1], last);
        }
        Ok((within, cycles, self.steps.partition_point(|step| step.input() <= within).saturating_sub(1)))
    }

    /// The position at an input, and the derivatives of the coordinates by arc length, with the parameter.
    pub(crate) fn near(&self, input: M::Scalar) -> Result<(M::Coordinates, M::Rates), PathErrorOf<M>> {
        let (within, cycles, place) = self.place(input)?;
        // The place is that of a step.
        let step = &self.steps[place];
        let (position, rates) = if step.input() == within {
            (step.position, step.rates)
        } else if is_rounding_error(self.mechanism(), within - step.input(), within) {
            // Too near for a step of a path; at a dead point there is no nearer position.
            let guess = M::with_inputs(&step.position, PerInput::<M>::from([within]));
            (newton(self.mechanism(), &guess).map_or(step.position, |found| found.coordinates), step.rates)
        } else {
            // Between its ends a motion is in the ranges; rounding errors of an end are not to stop it.
            let options = Options { joint_ranges: false, ..self.options.path };
            let from = |step: &Step<M>, rates: M::Rates| {
                let direction = Direction::Along(rates);
                let mut path = Path::with(self.mechanism(), &step.position, direction, options)?;
                let there = path.advance_to(within)?;
                Ok((there.position, there.rates))
            };
            match (from(step, step.rates), self.steps.get(place + 1)) {
                // From a dead point at which the motion begins a path may not start, or take a rounding error for a
                // reversal.
                (Err(error), Some(next)) => {
                    let (position, rates) =
                        from(next, backwards::<M>(&next.rates)).map_err(|_: PathErrorOf<M>| error)?;
                    (position, backwards::<M>(&rates))
                }
                (found, _) => found?,
            }
        };
        Ok((self.turned(&position, input, cycles), rates))
    }

    /// A position of a closed motion after so many cycles, at exactly this input.
    fn turned(&self, position: &M::Coordinates, input: M::Scalar, cycles: M::Scalar) -> M::Coordinates {
        let inputs = PerInput::<M>::from([input]);
        let (Some(first), Some(last)) = (self.steps.first(), self.steps.last()) else { return *position };
        if cycles.is_zero() {
            return M::with_inputs(position, inputs);
        }
        let moved = (M::unknowns(&last.position) - M::unknowns(&first.position)) * (cycles / M::Scalar::two_pi());
        let whole = moved.map(|turns| turns.round() * M::Scalar::two_pi());
        M::coordinates(M::unknowns(position) + whole, inputs)
    }

    /// The error of an input beyond an end of the motion.
    fn outside(&self, end: MotionEnd<M::Name>, input: M::Scalar, at: M::Scalar) -> PathErrorOf<M> {
        match end {
            MotionEnd::DeadPoint { group } => {
                PathError::DeadPoint { mechanism: self.mechanism.name(), group, gap: to_f64((input - at).abs()) }
            }
            MotionEnd::JointRange { of, end } => {
                PathError::JointRange { mechanism: self.mechanism.name(), of, end, gap: to_f64((input - at).abs()) }
            }
            MotionEnd::ChangePoint { groups } => {
                PathError::ChangePoint { mechanism: self.mechanism.name(), group: groups.first() }
            }
            MotionEnd::Range | MotionEnd::Open | MotionEnd::Closed { .. } => {
                out_of_range(self.mechanism(), "the input", input, self.inputs())
            }
        }
    }
}

impl<'a, M> RangeOfMotion<'a, M>
where
    M: Driven<Of: Assembly>,
{
    /// Follows the motion that these inputs are about: the first of them that has a position on the branch, within the declared
    /// ranges, chooses it. At a dead point or a change point it is the motion on which the branch is next to it.
    ///
    /// # Errors
    /// If no input has a position, the error of the first; if the motion of the first that has one cannot be followed, the
    /// error of [`of`](Self::of); [`PathError::NoDirection`] without inputs.
    pub fn on_branch<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        branch: M::Branch,
        inputs: impl IntoIterator<Item = M::Scalar>,
        options: RangeOptions<M::Scalar>,
    ) -> Result<Self, PathErrorOf<M>> {
        let (mechanism, inputs) = (mechanism.into_held(), inputs.into_iter().collect::<Vec<_>>());
        let position = |mechanism: &M, input: M::Scalar| -> Result<_, PathErrorOf<M>> {
            let [given, ..] = mechanism.inputs_at(input);
            let pose = mechanism.driven().assemble(given.into(), branch)?;
            Ok(M::coordinates(M::Of::unknowns(&M::Of::coordinates_of(&pose)), [input].into()))
        };
        let follow = |mechanism: &M, start: &M::Coordinates| followed(mechanism, start, options, AtDeadPoint::End);
        Self::by(mechanism, &inputs, position, follow, &options)
    }
}

/// True if the position is one at a parameter that differs by a whole turn, too.
fn repeats<M: Driven>(mechanism: &M, position: &M::Coordinates) -> bool {
    let turned = M::with_inputs(position, M::inputs(position).map(|input| input + M::Scalar::two_pi()));
    let pose = mechanism.pose_at(&turned);
    let (residual, scales) = (mechanism.residual(&pose), mechanism.residual_scales(&pose));
    // A declared range of more than a turn, or with one end, counts turns.
    let own = mechanism.range_names().position(|name| name == mechanism.input_name(0));
    let is_counted = own.and_then(|place| mechanism.ranged(place, position)).is_some_and(|own| !own.is_direction);
    mechanism.input_angles()[0]
        && !is_counted
        && same_inputs(mechanism, position, &turned)
        && residual.iter().zip(&scales).all(|(value, scale)| value.abs() <= *scale * nearly_zero())
}

/// True for a way of an angle of at most a turn, up to rounding errors: each direction is then passed once.
fn is_of_one_turn<T: Real>(way: T) -> bool {
    way <= T::two_pi() * (T::one() + T::default_epsilon() * real(EQUAL_ULPS))
}

/// True if a difference from an input is no more than rounding errors.
fn is_rounding_error<M: Mechanism>(mechanism: &M, off: M::Scalar, input: M::Scalar) -> bool {
    let least = if mechanism.input_angles()[0] { M::Scalar::one() } else { M::Scalar::zero() };
    off.abs() <= larger(input.abs(), least) * real(EQUAL_ULPS) * M::Scalar::default_epsilon()
}
