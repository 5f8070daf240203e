//! The ends of a call that are no value.

use std::fmt::{self, Display, Formatter};

use super::value::Value;

pub(crate) use crate::error::Error;

/// The reason for which an evaluation ends early.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The function returns this error.
    Error(Error),
    /// The function, or the function without a name, returns this value: the `?` of a value that is absent.
    Return(Value),
    Defect(Defect),
}

/// Code that has no meaning: it is damaged, or there is a mistake in this library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Defect(String);

impl Defect {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self(what.into())
    }

    #[cold]
    pub(crate) fn expected(what: &str, found: &Value) -> Self {
        Self(format!("expected {what}, found {}", word(found)))
    }
}

fn word(value: &Value) -> &'static str {
    match value {
        Value::Number(_) | Value::Wide(_) | Value::Traced(_) => "a number",
        Value::Flag(_) | Value::TracedFlag(_) => "a flag",
        Value::Count(_) => "a count",
        Value::Text(_) => "a text",
        Value::List(_) => "a list",
        Value::Matrix(_) => "a matrix",
        Value::Record(_) => "fields",
        Value::Absent => "no value",
        Value::Outcome(_) => "an outcome",
        Value::Side(_) => "a side",
        Value::Mode(_) => "a number of a mode",
        Value::Closure(_) => "a function",
        Value::At(_) => "a place",
        Value::Turns(_) => "turns",
        Value::Factors(_) => "factors",
        Value::Memory(_) => "a memory",
        Value::Modes(_) => "modes",
    }
}

impl Display for Defect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "the compiled code has no meaning: {}", self.0)
    }
}

impl std::error::Error for Defect {}

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
