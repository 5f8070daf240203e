//! The error of path following.

use core::fmt;

use super::digits::Digits;
use super::{InputError, Name, PositionError};
use crate::RangeEnd;

/// The reason why a mechanism cannot be followed along its motion. All measures but the distance to an input are
/// nondimensional: scaling all lengths of a mechanism changes none of them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PathError<N: Name = &'static str> {
    /// The input cannot reach the requested value: on this branch it reverses at a dead point.
    DeadPoint {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group that locks.
        group: N,
        /// The distance from the input to the requested value, in the unit of the input: radians, if it is an angle.
        gap: f64,
    },
    /// The input cannot reach the requested value: a coordinate or an output is at an end of its range before.
    JointRange {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The coordinate or the output.
        of: N,
        /// The end of its range.
        end: RangeEnd,
        /// The distance from the input to the requested value, in the unit of the input: radians, if it is an angle.
        gap: f64,
    },
    /// The path is at a change point, where motions of the mechanism cross, and none of them has been chosen.
    ChangePoint {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group that is singular; of several the first.
        group: N,
    },
    /// The initial direction is ambiguous: the start is a dead point, or the direction given is orthogonal to the path.
    NoDirection {
        /// The mechanism, or the driver of one.
        mechanism: N,
    },
    /// The path cannot be continued: even the shortest step fails. This happens where motions are closer to each other
    /// than rounding errors.
    Lost {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The unknowns of the group nearest to a singularity.
        group: N,
        /// The number of trials of the last step.
        iterations: usize,
        /// The largest residual of the last trial, divided by its scale.
        residual: f64,
        /// The smallest pivot of the Jacobian [J A] divided by the largest: 0 at a change point.
        regularity: f64,
    },
    /// The path takes more steps than allowed.
    TooManySteps {
        /// The mechanism, or the driver of one.
        mechanism: N,
        /// The steps taken.
        steps: usize,
    },
    /// A position on the path cannot be computed.
    Position(PositionError<N>),
    /// The input is invalid.
    Input(InputError<N>),
}

// A list of names need not be `Copy` where a name is.
impl<N: Name<List: Copy> + Copy> Copy for PathError<N> {}

impl<N: Name> PathError<N> {
    /// This error with other names: borrowed ones become owned.
    pub fn map_names<M: Name<List: FromIterator<M>>>(self, f: impl FnMut(N) -> M) -> PathError<M> {
        match self {
            Self::Position(error) => PathError::Position(error.map_names(f)),
            other => other.with_names(M::List::default(), f),
        }
    }

    /// This error with other names, and with the inputs of this list: owned names become borrowed.
    pub fn with_names<M: Name>(self, inputs: M::List, mut f: impl FnMut(N) -> M) -> PathError<M> {
        match self {
            Self::DeadPoint { mechanism, group, gap } => {
                PathError::DeadPoint { mechanism: f(mechanism), group: f(group), gap }
            }
            Self::JointRange { mechanism, of, end, gap } => {
                PathError::JointRange { mechanism: f(mechanism), of: f(of), end, gap }
            }
            Self::ChangePoint { mechanism, group } => {
                PathError::ChangePoint { mechanism: f(mechanism), group: f(group) }
            }
            Self::NoDirection { mechanism } => PathError::NoDirection { mechanism: f(mechanism) },
            Self::Lost { mechanism, group, iterations, residual, regularity } => {
                PathError::Lost { mechanism: f(mechanism), group: f(group), iterations, residual, regularity }
            }
            Self::TooManySteps { mechanism, steps } => PathError::TooManySteps { mechanism: f(mechanism), steps },
            Self::Position(error) => PathError::Position(error.with_names(inputs, f)),
            Self::Input(error) => PathError::Input(error.map_names(f)),
        }
    }
}

impl<N: Name> fmt::Display for PathError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadPoint { mechanism, group, gap } => {
                write!(f, "{mechanism} locks {} before this input: group {group} is at a dead point", Digits(*gap))
            }
            Self::JointRange { mechanism, of, end, gap } => {
                let end = if *end == RangeEnd::Least { "least" } else { "largest" };
                write!(f, "{mechanism} stops {} before this input: {of} has its {end} value", Digits(*gap))
            }
            Self::ChangePoint { mechanism, group } => {
                write!(
                    f,
                    "motions of {mechanism} cross here, where group {group} is singular: choose one by \
                     `Direction::Along` or `Path::choose`"
                )
            }
            Self::NoDirection { mechanism } => {
                write!(
                    f,
                    "the direction of {mechanism} is ambiguous here: give rates along its path by `Direction::Along`"
                )
            }
            Self::Lost { mechanism, group, iterations, residual, regularity } => write!(
                f,
                "the path of {mechanism} cannot be continued; group {group} is nearest to a singularity: after \
                 {iterations} trials relative residual {residual:.1e}, regularity of the Jacobian {regularity:.1e}"
            ),
            Self::TooManySteps { mechanism, steps } => {
                write!(f, "the path of {mechanism} has not reached the input after {steps} steps: raise `most_steps`")
            }
            Self::Position(error) => error.fmt(f),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl<N: Name> core::error::Error for PathError<N> {}

impl<N: Name> From<InputError<N>> for PathError<N> {
    fn from(error: InputError<N>) -> Self {
        Self::Input(error)
    }
}

impl<N: Name> From<PositionError<N>> for PathError<N> {
    fn from(error: PositionError<N>) -> Self {
        match error {
            PositionError::Input(error) => Self::Input(error),
            error => Self::Position(error),
        }
    }
}
