//! The error of circuits.

use core::fmt;

use crate::{Name, PathError, PositionError};

/// The reason why the circuits of a mechanism cannot be computed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CircuitError<N: Name = &'static str> {
    /// The positions at a start input cannot be listed.
    Position(PositionError<N>),
    /// The motion of a mode cannot be followed.
    Path {
        /// The mode, by its number among all modes at the start inputs.
        mode: usize,
        /// The reason.
        error: PathError<N>,
    },
}

impl<N: Name<List: Copy> + Copy> Copy for CircuitError<N> {}

impl<N: Name> fmt::Display for CircuitError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Position(error) => error.fmt(f),
            Self::Path { mode, error } => {
                write!(f, "the motion of mode {mode} cannot be followed: {error}; another start input may do")
            }
        }
    }
}

impl<N: Name> core::error::Error for CircuitError<N> {}

impl<N: Name> From<PositionError<N>> for CircuitError<N> {
    fn from(error: PositionError<N>) -> Self {
        Self::Position(error)
    }
}
