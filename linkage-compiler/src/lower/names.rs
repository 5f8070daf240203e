//! Names of values: those given by the user, and generated ones that describe the operation.

use std::collections::BTreeSet;

use rustc_hash::{FxHashMap, FxHashSet};

use super::schedule::Schedule;
use super::value::{Signed, Value, ValueId};
use crate::graph::{Graph, Number, SymbolId};
use crate::program::{LONGEST_NAME, Taken};

/// The names of the values and symbols of one kernel so far.
#[derive(Debug, Clone)]
pub(super) struct Names<'a> {
    graph: &'a Graph,
    pub(super) taken: Taken<'a>,
    values: FxHashMap<ValueId, String>,
    /// The values whose name stands for their negative.
    negatives: FxHashSet<ValueId>,
    symbols: FxHashMap<SymbolId, String>,
}

impl<'a> Names<'a> {
    pub(super) fn new(graph: &'a Graph, reserved: &'a BTreeSet<String>) -> Self {
        let (values, symbols) = (FxHashMap::default(), FxHashMap::default());
        Self { graph, taken: Taken::new(reserved), values, negatives: FxHashSet::default(), symbols }
    }

    /// The names of an inner scope, with the same symbols and no values.
    pub(super) fn within(&self) -> Self {
        Self { values: FxHashMap::default(), negatives: FxHashSet::default(), ..self.clone() }
    }

    /// The local name of a symbol.
    pub(super) fn symbol(&self, symbol: SymbolId) -> String {
        self.symbols.get(&symbol).map_or_else(|| self.graph.symbol_name(symbol).to_owned(), Clone::clone)
    }

    /// Names a symbol by its own name, or by one with a number if that is taken.
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
    pub(super) fn give_negative(&mut self, value: ValueId, preferred: &str) -> String {
        self.negatives.insert(value);
        self.give(value, preferred)
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

    /// Names a value by a preferred name, or by one with a number if that is taken.
    pub(super) fn give(&mut self, value: ValueId, preferred: &str) -> String {
        let name = self.taken.unique(preferred);
        self.set(value, name.clone());
        name
    }

    /// Names a value by its preferred name or by a description of its operation.
    pub(super) fn invent(&mut self, schedule: &Schedule, value: ValueId) -> String {
        let preferred = match schedule.name(value) {
            Some((name, false)) => Some(name.to_owned()),
            _ => self.describe(schedule, value),
        };
        let name = match preferred.filter(|preferred| preferred.len() <= LONGEST_NAME) {
            Some(preferred) => self.taken.unique(&preferred),
            None => self.taken.numbered(kind(schedule.value(value)), 1),
        };
        self.set(value, name.clone());
        name
    }

    /// A name made of the names of the operands, if all have one.
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
            // (-x)^2 = x^2: the sign of the name does not matter.
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

    /// The name of an operand, or a description of a short inline expression.
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

    /// The name of a value, unless it stands for the negative.
    fn text(&self, schedule: &Schedule, value: ValueId) -> Option<String> {
        self.get(schedule, value).filter(|_| !self.is_negative(value)).map(str::to_owned)
    }
}

/// The stem of the numbered name of a value without description.
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
