//! Names that are undeclared or stand without an operator, read as what is meant.

use proc_macro2::Ident;

use super::expression::Lowering;
use super::name::Name;
use super::scope::{VECTOR_FUNCTIONS, Value};
use crate::diagnostics::Region;
use crate::graph::{Function, NodeId};
use crate::syntax::ExpressionId;

impl Lowering<'_> {
    /// The variable of an undeclared name: next to `@` it is a scalar, so that the structure of the loop is known.
    pub(super) fn undeclared(&mut self, id: ExpressionId) -> Option<NodeId> {
        let name = self.expressions.as_name(id).filter(|name| !self.scope.is_declared(name))?;
        let symbol = *self
            .undeclared_symbols
            .entry(name.to_string())
            .or_insert_with(|| self.graph.symbol(Name::new(name).field));
        Some(self.graph.variable(symbol))
    }

    /// True for a function of the language.
    pub(super) fn is_function(&self, name: &str) -> bool {
        let is_vector_function = VECTOR_FUNCTIONS.iter().any(|(other, _)| *other == name);
        Function::named(name).is_some() || is_vector_function || (self.is_law && name == "rate")
    }

    /// A name before a factor without an operator: a function without parentheses, or a product without `*`.
    pub(super) fn adjacent(&mut self, name: &Ident, operand: ExpressionId, region: Region) -> Value {
        let text = name.to_string();
        let is_function = self.is_function(&text) || self.scope.function(&text).is_some();
        if is_function && !self.scope.is_symbol(name) {
            self.diagnostics.error(region, format_args!("write parentheses: `{text}(…)`"));
        } else {
            let message = "expected an operator before this: write `*` for a product";
            self.diagnostics.error(self.expressions.region(operand), message);
            self.scope.look_up(name, self.diagnostics);
        }
        Value::Poison
    }
}
