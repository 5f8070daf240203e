//! The ends of a call that are no value.

use super::defect::Defect;
use super::value::Value;
use crate::error::Error;

/// The reason for which an evaluation ends early.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The function returns this error.
    Error(Error),
    /// The function, or the function without a name, returns this value: the `?` of a value that is absent.
    Return(Value),
    Defect(Defect),
}

/// The result of an evaluation.
pub(crate) type Evaluated<T> = Result<T, Box<Failure>>;

impl From<Defect> for Box<Failure> {
    #[cold]
    fn from(defect: Defect) -> Self {
        Self::new(Failure::Defect(defect))
    }
}

impl From<Error> for Box<Failure> {
    #[cold]
    fn from(error: Error) -> Self {
        Self::new(Failure::Error(error))
    }
}
