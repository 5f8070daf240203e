//! Powers: exponents are integers that a power can have.

use super::resolver::Resolver;
use super::scope::Value;
use crate::graph::{Fault, LARGEST_EXPONENT, Number};
use crate::syntax::ExpressionId;

impl Resolver<'_> {
    pub(super) fn power(&mut self, base: ExpressionId, exponent: ExpressionId) -> Value {
        if let Value::Vector(..) = self.value(base) {
            let message = "a vector has no power: use `dot(P, P)` for the square of its length";
            self.diagnostics.error(self.expressions.region(base), message);
            return Value::Poison;
        }
        let (Some(base), Some(node)) = (self.scalar(base), self.scalar(exponent)) else { return Value::Poison };
        // A reported product with a name.
        if self.expressions.suffix(exponent.index()).is_some() || self.has_unit(exponent, "an exponent") {
            return Value::Poison;
        }
        let region = self.expressions.region(exponent);
        let number = self.graph.as_number(node);
        let is_integer = number.is_some_and(|number| number.to_f64().fract() == 0.0);
        let integer = number.and_then(Number::as_integer).and_then(|n| i32::try_from(n).ok());
        match integer.filter(|integer| integer.unsigned_abs() <= LARGEST_EXPONENT.unsigned_abs()) {
            Some(integer) => Value::Scalar(self.graph.power(base, integer)),
            None if is_integer => {
                self.diagnostics.error(region, Fault::ExponentOverflow);
                Value::Poison
            }
            None => {
                self.diagnostics.error(region, "an exponent must be an integer: write a root as `sqrt(…)`");
                Value::Poison
            }
        }
    }
}
