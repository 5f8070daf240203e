//! Why a path cannot be followed.

use core::fmt;

use super::{InputError, PositionError};

/// Why a mechanism cannot be followed along its motion. All measures are pure numbers: scaling all lengths of a
/// mechanism changes none of them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PathError {
    /// The input cannot reach the value that is asked for: on this branch it turns back at a dead point.
    DeadPoint {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that locks.
        group: &'static str,
        /// How far the input stays from what is asked for, in radians or beside the lengths of its loops.
        gap: f64,
    },
    /// Motions of the mechanism cross here, and nothing says which of them is meant.
    ChangePoint {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is singular; of several the first.
        group: &'static str,
    },
    /// At this start the input does not say where the path goes: it is a dead point, or the direction given is
    /// across the path.
    NoDirection {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
    },
    /// The path cannot be followed on: the shortest step fails. Where motions are closer to each other than rounding can
    /// tell, it ends.
    Lost {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The unknowns of the group that is nearest to a singularity.
        group: &'static str,
        /// Trials of the last step.
        iterations: usize,
        /// The largest residual of the last trial beside the size of its closure.
        residual: f64,
        /// The smallest pivot of the whole Jacobian of the closures beside the largest: 0 is a change point.
        regularity: f64,
    },
    /// The path is longer than the steps that were allowed.
    TooManySteps {
        /// The mechanism, or the driver of one.
        mechanism: &'static str,
        /// The steps taken.
        steps: usize,
    },
    /// A position on the path has no value.
    Position(PositionError),
    /// What was given cannot be used.
    Input(InputError),
}

impl fmt::Display for PathError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadPoint { mechanism, group, gap } => {
                write!(f, "{mechanism} locks {gap:.1e} before this input: {group} are at a dead point")
            }
            Self::ChangePoint { mechanism, group } => {
                write!(f, "motions of {mechanism} cross here, where {group} are singular: choose one")
            }
            Self::NoDirection { mechanism } => {
                write!(f, "the direction given does not say which way {mechanism} moves from this start")
            }
            Self::Lost { mechanism, group, iterations, residual, regularity } => write!(
                f,
                "the path of {mechanism} cannot be followed on, {group} being nearest to a singularity: after \
                 {iterations} trials relative residual {residual:.1e}, Jacobian regular to {regularity:.1e}"
            ),
            Self::TooManySteps { mechanism, steps } => {
                write!(f, "the path of {mechanism} goes on after {steps} steps")
            }
            Self::Position(error) => error.fmt(f),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for PathError {}

impl From<InputError> for PathError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl From<PositionError> for PathError {
    fn from(error: PositionError) -> Self {
        match error {
            PositionError::Input(error) => Self::Input(error),
            error => Self::Position(error),
        }
    }
}
