//! The motion that a list of inputs is about.
//!
//! One rule for tables, films and pages: the first input that has the position asked for chooses the motion, and every other
//! input belongs to the same motion, at its own turn, or has no position. An input whose position is outside of a declared
//! range has none. From a dead point or a change point no motion is followed: the position asked for next to it chooses one
//! that passes it.

use std::vec::Vec;

use super::follow::{AtDeadPoint, Followed, followed};
use super::{Driven, MotionEnd, RangeOfMotion, RangeOptions};
use crate::continuation::Options;
use crate::held::{Held, IntoHeld};
use crate::mechanism::check_ranges;
use crate::same_position::SamePosition;
use crate::scalar::arithmetic::*;
use crate::{BorrowedName, Mechanism, PathError, PathErrorOf, PositionError, Real, real};

/// The distances from a singular position at which the position asked for is sought, in units of the input.
const NEXT_TO: [f64; 3] = [1.0 / 64.0, 1.0 / 1024.0, 1.0 / 16384.0];

/// The most later inputs whose motions are followed to find one that passes a singular position: each may take thousands of
/// steps.
const MOST_LATER: usize = 8;

/// The most steps of a motion that is followed over the inputs that are asked for.
const MOST_STEPS: usize = 1_000_000;

/// A start, and the motion that was followed from it.
type Chosen<M> = (<M as Mechanism>::Coordinates, Followed<M>);

impl<'a, M: Driven> RangeOfMotion<'a, M> {
    /// The motion that these inputs are about: the first of them at which `position` has a value within the declared ranges
    /// chooses it. At a dead point or a change point, where motions meet, it is the motion on which `position` is next to it.
    ///
    /// The motion is that of [`over`](Self::over) these inputs.
    ///
    /// # Errors
    /// If no input has a position, the error of the first; if the motion of the first that has one cannot be followed, the
    /// error of [`over`](Self::over); [`PathError::NoDirection`] without inputs.
    pub fn chosen<By, E: From<PathErrorOf<M>>>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        inputs: impl IntoIterator<Item = M::Scalar>,
        position: impl FnMut(M::Scalar) -> Result<M::Coordinates, E>,
        options: RangeOptions<M::Scalar>,
    ) -> Result<Self, E> {
        let (mechanism, inputs) = (mechanism.into_held(), inputs.into_iter().collect::<Vec<_>>());
        let ends = ends(&inputs);
        let mut position = position;
        let follow = |mechanism: &M, start: &M::Coordinates| followed_over(mechanism, start, ends, options);
        Self::by(mechanism, &inputs, |_, input| position(input), follow, &options)
    }

    /// Follows the motion through a position to both of its ends. A motion without end, as of a rack, or too long to be
    /// followed, is followed over the inputs between these two.
    ///
    /// # Errors
    /// Those of [`of`](Self::of).
    pub fn over<By>(
        mechanism: impl IntoHeld<'a, By, Of = M>,
        start: &M::Coordinates,
        inputs: [M::Scalar; 2],
        options: RangeOptions<M::Scalar>,
    ) -> Result<Self, PathErrorOf<M>> {
        let mechanism = mechanism.into_held();
        let found = followed_over(&*mechanism, start, Some(inputs), options)?;
        Ok(Self::followed(mechanism, start, found))
    }

    /// The motion that these inputs are about, followed by a function.
    pub(super) fn by<E: From<PathErrorOf<M>>>(
        mechanism: Held<'a, M>,
        inputs: &[M::Scalar],
        mut position: impl FnMut(&M, M::Scalar) -> Result<M::Coordinates, E>,
        follow: impl Fn(&M, &M::Coordinates) -> Result<Followed<M>, PathErrorOf<M>>,
        options: &RangeOptions<M::Scalar>,
    ) -> Result<Self, E> {
        let mut at = |mechanism: &M, input: M::Scalar| {
            let start = position(mechanism, input)?;
            if options.path.joint_ranges {
                check_ranges(mechanism, &start).map_err(PathError::from)?;
            }
            Ok::<_, E>(start)
        };
        let mut first = None;
        for (place, &input) in inputs.iter().enumerate() {
            let start = match at(&mechanism, input) {
                Ok(start) => start,
                Err(error) => {
                    first.get_or_insert(error);
                    continue;
                }
            };
            return match follow(&mechanism, &start) {
                Ok(found) => Ok(Self::followed(mechanism, &start, found)),
                Err(error) if is_singular(&error) => next_to(&*mechanism, &start, &inputs[place..], &mut at, &follow)
                    .map(|(start, found)| Self::followed(mechanism, &start, found))
                    .ok_or_else(|| E::from(error)),
                Err(error) => Err(E::from(error)),
            };
        }
        Err(first.unwrap_or_else(|| E::from(PathError::NoDirection { mechanism: mechanism.name() })))
    }
}

/// The motion on which the position asked for is next to a singular one, the first of these inputs; then that of a later one.
/// It passes the singular position.
fn next_to<M: Driven, E>(
    mechanism: &M,
    singular: &M::Coordinates,
    inputs: &[M::Scalar],
    position: &mut impl FnMut(&M, M::Scalar) -> Result<M::Coordinates, E>,
    follow: &impl Fn(&M, &M::Coordinates) -> Result<Followed<M>, PathErrorOf<M>>,
) -> Option<Chosen<M>> {
    let (&here, later) = inputs.split_first()?;
    let unit = SamePosition::at(mechanism, singular).parameter_unit();
    let falls = later.first().is_some_and(|next| *next < here);
    let ahead = if falls { -unit } else { unit };
    let near = NEXT_TO.into_iter().flat_map(|part| [here + ahead * real(part), here - ahead * real(part)]);
    let mut left = MOST_LATER;
    for (count, input) in near.chain(later.iter().copied()).enumerate() {
        let Ok(start) = position(mechanism, input) else { continue };
        if let Ok(found) = follow(mechanism, &start) {
            let range = RangeOfMotion::followed(Held::Borrowed(mechanism), &start, found);
            if range.has(singular).unwrap_or_default() {
                return Some((start, range.into_followed()));
            }
        }
        left -= usize::from(count >= 2 * NEXT_TO.len());
        if left == 0 {
            break;
        }
    }
    None
}

/// True for the errors of a start from which motions go in several directions, or none.
fn is_singular<N: BorrowedName>(error: &PathError<N>) -> bool {
    matches!(
        error,
        PathError::NoDirection { .. }
            | PathError::ChangePoint { .. }
            | PathError::Lost { iterations: 0, .. }
            | PathError::Position(PositionError::Singular { .. })
    )
}

/// The least and the largest of inputs, if they differ.
fn ends<T: Real>(inputs: &[T]) -> Option<[T; 2]> {
    let first = *inputs.first()?;
    let [least, largest] =
        inputs.iter().fold([first; 2], |[least, largest], &input| [least.min(input), largest.max(input)]);
    (least < largest).then_some([least, largest])
}

/// The motion through a position to both ends, or over inputs where it has none.
fn followed_over<M: Driven>(
    mechanism: &M,
    start: &M::Coordinates,
    inputs: Option<[M::Scalar; 2]>,
    options: RangeOptions<M::Scalar>,
) -> Result<Followed<M>, PathErrorOf<M>> {
    let whole = followed(mechanism, start, options, AtDeadPoint::End);
    let Some([least, largest]) = inputs.map(|[one, other]| [one.min(other), one.max(other)]) else { return whole };
    let over = || {
        let path = Options { range: Some([least, largest]), most_steps: MOST_STEPS, ..options.path };
        followed(mechanism, start, RangeOptions { path, most_turns: u32::MAX }, AtDeadPoint::End)
    };
    match whole {
        // A motion that goes on, or with a place outside of these inputs from which it is not followed.
        Ok(found) if found.ends.contains(&MotionEnd::Open) => {
            let [from, to] = found.inputs();
            if from <= least && largest <= to { Ok(found) } else { over() }
        }
        Ok(found) => Ok(found),
        Err(error) if is_singular(&error) || matches!(error, PathError::Position(_)) => Err(error),
        Err(error) => over().map_err(|_| error),
    }
}
