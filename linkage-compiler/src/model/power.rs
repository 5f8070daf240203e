//! Powers: exponents are integers that a power can have.

use super::functions;
use super::resolver::Resolver;
use super::scope::Value;
use crate::graph::Fault;
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
        let is_integer = self.graph.as_number(node).is_some_and(|number| number.to_f64().fract() == 0.0);
        match functions::power(&mut self.graph, base, node) {
            Some(power) => Value::Scalar(power),
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
