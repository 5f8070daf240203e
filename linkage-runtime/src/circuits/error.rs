//! The error of circuits.

use core::fmt;

use crate::{PathError, PositionError};

/// The reason why the circuits of a mechanism cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CircuitError {
    /// The positions at a start input cannot be listed.
    Position(PositionError),
    /// The motion of a mode cannot be followed.
    Path {
        /// The mode, by its number among all modes at the start inputs.
        mode: usize,
        /// The reason.
        error: PathError,
    },
}

impl fmt::Display for CircuitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position(error) => error.fmt(f),
            Self::Path { mode, error } => {
                write!(f, "the motion of mode {mode} cannot be followed: {error}; another start input may do")
            }
        }
    }
}

impl core::error::Error for CircuitError {}

impl From<PositionError> for CircuitError {
    fn from(error: PositionError) -> Self {
        Self::Position(error)
    }
}
