//! The error type for functions that return several kinds of errors.

use core::fmt;

#[cfg(feature = "dynamics")]
use linkage_dynamics::MotionError;
#[cfg(feature = "std")]
use linkage_runtime::circuits::CircuitError;
use linkage_runtime::{InputError, PathError, PositionError};

/// Any error of this crate, for functions that return several kinds: `?` converts the other error types to it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Error {
    /// A number or a setting is invalid.
    Input(InputError),
    /// A position, velocity or force cannot be computed.
    Position(PositionError),
    /// A path cannot be followed.
    Path(PathError),
    /// The circuits of a mechanism cannot be computed.
    #[cfg(feature = "std")]
    Circuit(CircuitError),
    /// A motion cannot be computed.
    #[cfg(feature = "dynamics")]
    Motion(MotionError),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Position(error) => error.fmt(f),
            Self::Path(error) => error.fmt(f),
            #[cfg(feature = "std")]
            Self::Circuit(error) => error.fmt(f),
            #[cfg(feature = "dynamics")]
            Self::Motion(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Error {}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl From<PositionError> for Error {
    fn from(error: PositionError) -> Self {
        match error {
            PositionError::Input(error) => Self::Input(error),
            error => Self::Position(error),
        }
    }
}

impl From<PathError> for Error {
    fn from(error: PathError) -> Self {
        match error {
            PathError::Input(error) => Self::Input(error),
            PathError::Position(error) => Self::Position(error),
            error => Self::Path(error),
        }
    }
}

#[cfg(feature = "std")]
impl From<CircuitError> for Error {
    fn from(error: CircuitError) -> Self {
        match error {
            CircuitError::Position(error) => error.into(),
            error => Self::Circuit(error),
        }
    }
}

#[cfg(feature = "dynamics")]
impl From<MotionError> for Error {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Input(error) => Self::Input(error),
            MotionError::Position(error) => Self::Position(error),
            MotionError::Path(error) => Self::Path(error),
            error => Self::Motion(error),
        }
    }
}
