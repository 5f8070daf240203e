//! Names of values: the user's own, and new ones made of what a value is computed from.

use std::collections::BTreeSet;

use rustc_hash::{FxHashMap, FxHashSet};

use super::schedule::Schedule;
use super::value::{Signed, Value, ValueId};
use crate::graph::{Graph, Number, SymbolId};
use crate::program::{LONGEST_NAME, Taken};

/// The names of the values and symbols of one kernel, as far as its lines have been written.
#[derive(Debug, Clone)]
pub(super) struct Names<'a> {
    graph: &'a Graph,
    pub(super) taken: Taken<'a>,
    values: FxHashMap<ValueId, String>,
    /// The values whose names are those of their negatives.
    negatives: FxHashSet<ValueId>,
    symbols: FxHashMap<SymbolId, String>,
}

impl<'a> Names<'a> {
    pub(super) fn new(graph: &'a Graph, reserved: &'a BTreeSet<String>) -> Self {
        let (values, symbols) = (FxHashMap::default(), FxHashMap::default());
        Self { graph, taken: Taken::new(reserved), values, negatives: FxHashSet::default(), symbols }
    }

    /// The names of a scope within this one: other values, the same symbols.
    pub(super) fn within(&self) -> Self {
        Self { values: FxHashMap::default(), negatives: FxHashSet::default(), ..self.clone() }
    }

    /// The local name of a symbol.
    pub(super) fn symbol(&self, symbol: SymbolId) -> String {
        self.symbols.get(&symbol).map_or_else(|| self.graph.symbol_name(symbol).to_owned(), Clone::clone)
    }

    /// Gives a symbol its own name, or one like it if that is taken.
    pub(super) fn introduce(&mut self, symbol: SymbolId) -> String {
        let name = self.taken.unique(self.graph.symbol_name(symbol));
        self.symbols.insert(symbol, name.clone());
        name
    }

    /// Gives a symbol the name of something else.
    pub(super) fn call(&mut self, symbol: SymbolId, name: String) {
        self.symbols.insert(symbol, name);
    }

    /// Gives a value the name of its negative.
    pub(super) fn give_negative(&mut self, value: ValueId, wish: &str) -> String {
        self.negatives.insert(value);
        self.give(value, wish)
    }

    pub(super) fn is_negative(&self, value: ValueId) -> bool {
        self.negatives.contains(&value)
    }

    pub(super) fn set(&mut self, value: ValueId, name: String) {
        self.values.insert(value, name);
    }

    /// The name of a value that has one.
    pub(super) fn get(&self, schedule: &Schedule, value: ValueId) -> Option<&str> {
        let name = match schedule.value(value) {
            Value::Symbol(symbol) => self.symbols.get(symbol),
            _ => self.values.get(&value),
        };
        name.map(String::as_str)
    }

    /// A name like this one for a value.
    pub(super) fn give(&mut self, value: ValueId, wish: &str) -> String {
        let name = self.taken.unique(wish);
        self.set(value, name.clone());
        name
    }

    /// Names a value after what it is made of.
    pub(super) fn invent(&mut self, schedule: &Schedule, value: ValueId) -> String {
        let wish = match schedule.name(value) {
            Some((name, false)) => Some(name.to_owned()),
            _ => self.describe(schedule, value),
        };
        let name = match wish.filter(|wish| wish.len() <= LONGEST_NAME) {
            Some(wish) => self.taken.unique(&wish),
            None => self.taken.numbered(kind(schedule.value(value)), 1),
        };
        self.set(value, name.clone());
        name
    }

    /// A name made of the names of the parts, if all have one.
    fn describe(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        match schedule.value(value) {
            Value::Product(factors) => {
                let parts: Option<Vec<String>> = factors.iter().map(|&factor| self.part(schedule, factor)).collect();
                Some(parts?.join("_"))
            }
            Value::Sum(terms) => {
                let &[Signed { value: a, .. }, Signed { negative, value: b }] = terms.as_slice() else { return None };
                let sign = if negative { "minus" } else { "plus" };
                Some(format!("{}_{sign}_{}", self.part(schedule, a)?, self.part(schedule, b)?))
            }
            Value::Quotient(above, below) if is_one(schedule, *above) => {
                Some(format!("inverse_{}", self.text(schedule, *below)?))
            }
            Value::Quotient(above, below) => {
                Some(format!("{}_over_{}", self.part(schedule, *above)?, self.part(schedule, *below)?))
            }
            // The square of the negative is the same.
            Value::Square(base) => Some(format!("{}_squared", self.get(schedule, *base)?)),
            Value::Call(function, arguments) => {
                let &[argument] = arguments.as_slice() else { return None };
                let argument =
                    self.text(schedule, argument.value).or_else(|| self.describe(schedule, argument.value))?;
                Some(format!("{}_{argument}", function.operation().name))
            }
            Value::External(external, _) => self.graph.external_name(external).map(str::to_owned),
            _ => None,
        }
    }

    /// A part by its name, or by a word for the small things that are written inline.
    fn part(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        let is_small = |value: &ValueId| {
            matches!(schedule.value(*value), Value::Symbol(_)) || self.get(schedule, *value).is_some()
        };
        match schedule.value(value) {
            Value::Constant(Number::Ratio(1, 2)) => Some("half".to_owned()),
            Value::Constant(Number::Ratio(2, 1)) => Some("twice".to_owned()),
            Value::Square(base) if is_small(base) => self.describe(schedule, value),
            Value::Quotient(above, below) if is_one(schedule, *above) && is_small(below) => {
                self.describe(schedule, value)
            }
            Value::Product(factors) if factors.iter().all(is_small) => {
                self.text(schedule, value).or_else(|| self.describe(schedule, value))
            }
            _ => self.text(schedule, value),
        }
    }

    /// The name of a value, but for that of its negative.
    fn text(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        self.get(schedule, value).filter(|_| !self.is_negative(value)).map(str::to_owned)
    }
}

/// The name of a value that cannot be described, before its number.
fn kind(value: &Value) -> &'static str {
    match value {
        Value::Sum(_) => "sum",
        Value::Product(_) => "product",
        Value::Quotient(..) => "quotient",
        Value::Square(_) => "square",
        Value::Call(function, _) => function.operation().name,
        _ => "value",
    }
}

fn is_one(schedule: &Schedule, value: ValueId) -> bool {
    matches!(schedule.value(value), Value::Constant(number) if number.is_one())
}
