//! Calls of the compiled functions of a mechanism with values of its parameters.

use linkage_runtime::{Dim, PositionError};

use super::parameters::Parameters;
use super::{AtRunTime, Prepared};
use crate::machine::{Failure, Value};

impl Prepared<'_> {
    /// The mechanism with other values of its parameters.
    fn with(&self, parameters: &[f64]) -> Value {
        let numbers = parameters.iter().copied().map(Value::Number);
        Value::record(self.driver.parameters.iter().copied().zip(numbers))
    }
}

impl<'p, V: Dim, P: Parameters> AtRunTime<'p, V, P> {
    fn called(&self, function: &str, arguments: impl IntoIterator<Item = Value>) -> Result<Value, Box<Failure>> {
        match self.parameters.instead() {
            None => self.prepared.called(&self.prepared.own, function, arguments),
            Some(values) => self.prepared.called(&self.prepared.with(values), function, arguments),
        }
    }

    /// Calls a function that cannot fail; nothing if it does.
    pub(crate) fn value(&self, function: &str, arguments: impl IntoIterator<Item = Value>) -> Value {
        self.prepared.or_nothing(self.called(function, arguments))
    }

    /// Calls a function that can fail.
    pub(crate) fn result(
        &self,
        function: &str,
        arguments: impl IntoIterator<Item = Value>,
    ) -> Result<Value, PositionError<&'p str>> {
        self.called(function, arguments).map_err(|failure| self.prepared.error(failure))
    }
}
