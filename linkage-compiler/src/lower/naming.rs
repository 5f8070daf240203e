//! Names of values: those given by the user, and generated ones that describe the operation. They are given last.

use linkage_ir::ValueId;
use rustc_hash::FxHashSet;

use super::code::Names;
use super::value::{Leaf, Signed, Value};
use super::values::Values;
use crate::graph::{Function, Graph, Number, SymbolId};
use crate::program::{Intrinsic, LONGEST_NAME, Taken};

/// The preferred name of a bound value.
#[derive(Debug, Clone)]
pub(super) enum Hint {
    /// The name of a symbol.
    Symbol(SymbolId),
    Preferred(String),
    /// A name for the value before a description of its operation.
    Described(Option<String>),
    /// `is_regular_` and the name of another value.
    Regular(ValueId),
    /// The sine or cosine of the angle of this field of a pose.
    Direction(Function, String),
    /// This name, which is not in use in its scope.
    Fixed(String),
}

/// Values to be named, in order.
#[derive(Debug, Clone)]
pub(super) enum Hinted {
    Value(ValueId, Hint),
    /// Those of a function within this one: its names are free afterwards.
    Within(Vec<Hinted>),
}

/// Names all bound values; `taken` are the names that no value may have.
pub(super) fn names(hints: &[Hinted], values: &Values, graph: &Graph, taken: Taken<'_>) -> Names {
    let names = vec![None; values.all.len()];
    let mut naming = Naming { graph, values, taken, names, symbols: FxHashSet::default() };
    naming.all(hints);
    let mut names = naming.names;
    for (name, is_bound) in names.iter_mut().zip(&values.is_bound) {
        name.take_if(|_| !is_bound);
    }
    names
}

struct Naming<'a> {
    graph: &'a Graph,
    values: &'a Values,
    taken: Taken<'a>,
    names: Names,
    /// The values that have the name of a symbol.
    symbols: FxHashSet<ValueId>,
}

impl Naming<'_> {
    fn all(&mut self, hints: &[Hinted]) {
        for hinted in hints {
            match hinted {
                Hinted::Value(id, hint) => {
                    let name = self.named(*id, hint);
                    self.names[id.index()] = Some(name);
                }
                Hinted::Within(inside) => {
                    let taken = self.taken.clone();
                    self.all(inside);
                    self.taken = taken;
                }
            }
        }
    }

    fn named(&mut self, id: ValueId, hint: &Hint) -> String {
        match hint {
            Hint::Symbol(symbol) => {
                self.symbols.insert(id);
                self.taken.unique(self.graph.symbol_name(*symbol))
            }
            Hint::Preferred(preferred) => self.taken.unique(preferred),
            Hint::Regular(of) => {
                let preferred = format!("is_regular_{}", self.name(*of).unwrap_or_default());
                self.taken.unique(&preferred)
            }
            Hint::Direction(function, field) => self.taken.unique(&format!("{}_{field}", function.name())),
            Hint::Fixed(name) => name.clone(),
            Hint::Described(preferred) => {
                let preferred = preferred.clone().or_else(|| self.describe(id));
                match preferred.filter(|preferred| preferred.len() <= LONGEST_NAME) {
                    Some(preferred) => self.taken.unique(&preferred),
                    None => self.taken.numbered(self.kind(id), 1),
                }
            }
        }
    }

    /// The operation of a value without its sign.
    fn magnitude(&self, id: ValueId) -> &Value {
        match self.values.get(id) {
            Value::Negative(inside) => self.values.get(*inside),
            value => value,
        }
    }

    fn name(&self, id: ValueId) -> Option<&str> {
        self.names[id.index()].as_deref()
    }

    /// A name made of the names of the operands, if all have one.
    fn describe(&self, id: ValueId) -> Option<String> {
        match self.magnitude(id) {
            Value::Product(factors) => {
                let parts: Option<Vec<String>> = factors.iter().map(|&factor| self.part(factor)).collect();
                Some(parts?.join("_"))
            }
            Value::Sum(terms) => {
                let &[a, b] = terms.as_slice() else { return None };
                // The description of a value whose name stands for its negative is that of the value.
                let is_negative = |term: Signed| {
                    term.negative != (self.name(term.value).is_some() && self.values.is_negative[term.value.index()])
                };
                let (first, second, sign) = match [a, b].map(is_negative) {
                    [false, false] => (a, b, "plus"),
                    [false, true] => (a, b, "minus"),
                    [true, false] => (b, a, "minus"),
                    [true, true] => return None,
                };
                Some(format!("{}_{sign}_{}", self.part(first.value)?, self.part(second.value)?))
            }
            Value::Quotient(above, below) if self.is_one(*above) => Some(format!("inverse_{}", self.text(*below)?)),
            Value::Quotient(above, below) => Some(format!("{}_over_{}", self.part(*above)?, self.part(*below)?)),
            // (-x)^2 = x^2: the sign of the name does not matter.
            Value::Square(base) => Some(format!("{}_squared", self.name(*base)?)),
            Value::Intrinsic(Intrinsic::Square, _, base) => Some(format!("{}_squared", self.name(*base.first()?)?)),
            value => match self.call(value) {
                Some((function, Some(argument))) => {
                    let argument = self.text(argument).or_else(|| self.describe(argument))?;
                    Some(format!("{}_{argument}", function.name()))
                }
                _ => match value {
                    Value::Given(Leaf::External(external, _)) => self.graph.external_name(external).map(str::to_owned),
                    _ => None,
                },
            },
        }
    }

    /// The function of a value, and its argument if it has one only.
    fn call(&self, value: &Value) -> Option<(Function, Option<ValueId>)> {
        let of_lanes = [Function::Sin, Function::Cos, Function::Atan2, Function::Hypot];
        match value {
            Value::Call(function, arguments) => match arguments.as_slice() {
                &[Signed { value, .. }] => Some((*function, Some(value))),
                _ => Some((*function, None)),
            },
            Value::Intrinsic(of, _, arguments) => {
                let is_it = |function: &Function| Intrinsic::in_lane_of(*function).is_some_and(|[form, _]| form == *of);
                let function = of_lanes.into_iter().find(is_it)?;
                let argument = match arguments.as_slice() {
                    &[only] => Some(only),
                    _ => None,
                };
                Some((function, argument))
            }
            _ => None,
        }
    }

    /// The name of an operand, or a description of a short inline expression.
    fn part(&self, id: ValueId) -> Option<String> {
        let is_small = |value: &ValueId| self.name(*value).is_some();
        match self.magnitude(id) {
            _ if self.symbols.contains(&id) => self.text(id),
            Value::Constant(Number::Ratio(1, 2)) | Value::Exact(Number::Ratio(1, 2)) => Some("half".to_owned()),
            Value::Constant(Number::Ratio(2, 1)) | Value::Exact(Number::Ratio(2, 1)) => Some("twice".to_owned()),
            Value::Square(base) if is_small(base) => self.describe(id),
            Value::Intrinsic(Intrinsic::Square, _, base) if base.iter().all(is_small) => self.describe(id),
            Value::Quotient(above, below) if self.is_one(*above) && is_small(below) => self.describe(id),
            Value::Product(factors) if factors.iter().all(is_small) => self.text(id).or_else(|| self.describe(id)),
            _ => self.text(id),
        }
    }

    /// The name of a value, unless it stands for the negative.
    fn text(&self, id: ValueId) -> Option<String> {
        self.name(id).filter(|_| !self.values.is_negative[id.index()]).map(str::to_owned)
    }

    /// The stem of the numbered name of a value without description.
    fn kind(&self, id: ValueId) -> &'static str {
        match self.magnitude(id) {
            Value::Sum(_) => "sum",
            Value::Product(_) => "product",
            Value::Quotient(..) => "quotient",
            Value::Square(_) | Value::Intrinsic(Intrinsic::Square, ..) => "square",
            value => self.call(value).map_or("value", |(function, _)| function.name()),
        }
    }

    fn is_one(&self, id: ValueId) -> bool {
        matches!(self.values.get(id), Value::Constant(number) if number.is_one())
    }
}
