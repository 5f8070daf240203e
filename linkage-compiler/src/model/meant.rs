//! Names that are undeclared or stand without an operator, read as what is meant.

use proc_macro2::Ident;

use super::functions::VECTOR_FUNCTIONS;
use super::name::Name;
use super::resolver::{Mode, Resolver};
use super::scope::Value;
use crate::diagnostics::Region;
use crate::graph::{Function, NodeId};
use crate::syntax::{Body, ExpressionId, Statement, StatementKind, unknown_unit};

impl Resolver<'_> {
    /// The variable of an undeclared name: next to `@` it is a scalar, so that the structure of the loop is known.
    pub(super) fn undeclared(&mut self, id: ExpressionId) -> Option<NodeId> {
        let name =
            self.expressions.as_name(id).filter(|name| !self.scope.is_declared(name) && !self.scope.is_other(name))?;
        let symbol =
            *self.assumed.symbols.entry(name.to_string()).or_insert_with(|| self.graph.symbol(Name::new(name).field));
        Some(self.graph.variable(symbol))
    }

    /// True for a function of the language.
    pub(super) fn is_function(&self, name: &str) -> bool {
        let is_vector_function = VECTOR_FUNCTIONS.iter().any(|(other, _)| *other == name);
        Function::named(name).is_some() || is_vector_function || (self.mode == Mode::Law && name == "rate")
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

    /// A number with a suffix that is no unit: a product with the name that it is, or a number with another unit.
    pub(super) fn suffixed(&mut self, digits: &str, suffix: &Ident, is_hexadecimal: bool, region: Region) -> Value {
        let (text, is_time) = (suffix.to_string(), self.mode == Mode::Law && suffix == "t");
        let Some(number) = self.number(digits, region) else { return Value::Poison };
        let number = self.graph.number(number);
        if self.scope.is_other(suffix) {
            return self.scope.look_up(suffix, self.diagnostics);
        }
        // A default depends on no names: there it is a unit.
        let is_name = text == "pi" || self.mode != Mode::Default && (is_time || self.scope.is_declared(suffix));
        if is_name {
            let message = format!("expected an operator: write `{digits}*{text}` for a product");
            self.diagnostics.error(region, message);
            let other = match (is_time, self.motion.time) {
                (true, Some(time)) => Value::Scalar(time),
                _ if text == "pi" => Value::Scalar(self.graph.pi()),
                _ => self.scope.look_up(suffix, self.diagnostics),
            };
            return match other {
                Value::Scalar(node) => Value::Scalar(self.graph.multiply(number, node)),
                Value::Vector(x, y) => Value::Vector(self.graph.multiply(number, x), self.graph.multiply(number, y)),
                Value::Poison => Value::Poison,
            };
        }
        if is_hexadecimal {
            // `0x10deg` is the number 0x10de and a `g`.
            let angle = digits.parse::<u128>().ok().filter(|value| text == "g" && value & 0xff == 0xde);
            let written = angle.map_or_else(|| "it as a decimal".to_owned(), |value| format!("`{}deg`", value >> 8));
            let message =
                format!("a hexadecimal number has no unit, since `a` to `f` are digits of it: write {written}");
            self.diagnostics.error(region, message);
            return Value::Poison;
        }
        // A unit that is written at each number is one mistake.
        if !self.expressions.has_reported(&text) && self.reported.units.insert(text.clone()) {
            self.diagnostics.error(region, unknown_unit(&text, digits));
        }
        let is_degrees = text.starts_with("deg");
        let pi = self.graph.pi();
        Value::Scalar(if is_degrees { self.graph.product(&[(number, 1), (pi, 1)]) } else { number })
    }

    /// The names of bodies, drivers and scenes with the message of their use as a value.
    pub(super) fn name_others(&mut self, mechanism: &Ident, statements: &[Statement]) {
        let without_value = "which has no value: write a point, an output, a coordinate or a parameter";
        let mut others = vec![(mechanism.to_string(), format!("`{mechanism}` is the mechanism, {without_value}"))];
        for statement in statements {
            let (name, message) = match &statement.kind {
                StatementKind::Body(body) => (&body.name, self.value_of_body(body)),
                StatementKind::Drive { name, .. } => (name, format!("`{name}` is a driver, {without_value}")),
                StatementKind::Scene(scene) => (&scene.name, format!("`{}` is a scene, {without_value}", scene.name)),
                _ => continue,
            };
            others.push((name.to_string(), message));
        }
        self.scope.others = others.into_iter().collect();
    }

    /// The message of a body where a value belongs, with the names of its centre and its angle.
    fn value_of_body(&self, body: &Body) -> String {
        let name = &body.name;
        let named = |word: &str| {
            let value = self.expressions.as_name(body.property(word)?).filter(|value| *value != name)?;
            Some(value.to_string())
        };
        let written = |word: &str| named(word).map_or_else(|| format!("its {word}"), |of| format!("its {word} `{of}`"));
        format!("`{name}` is a body: write a point of it, such as {}, or {}", written("center"), written("angle"))
    }
}
