//! The reason for which a call has no value.

use std::fmt::{self, Display, Formatter};

use crate::error::{Error, Mistake};
use crate::machine::{Defect, Failure};

/// The reason for which a call has no value.
#[derive(Debug, Clone, PartialEq)]
pub enum CallError {
    /// The error of the function.
    Function(Error),
    /// A mistake in the call.
    Mistake(Mistake),
    /// The compiled code is damaged.
    Defect(Defect),
}

impl Display for CallError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Function(error) => error.fmt(f),
            Self::Mistake(error) => error.fmt(f),
            Self::Defect(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for CallError {}

impl From<Mistake> for CallError {
    fn from(mistake: Mistake) -> Self {
        Self::Mistake(mistake)
    }
}

impl From<Box<Failure>> for CallError {
    fn from(failure: Box<Failure>) -> Self {
        match *failure {
            Failure::Error(error) => Self::Function(error),
            Failure::Return(_) => Self::Defect(Defect::new("a value outside of a function")),
            Failure::Defect(defect) => Self::Defect(defect),
        }
    }
}
