//! The values of a function while it is lowered, with what is known of each.

use linkage_ir::ValueId;

use super::uses::Uses;
use super::value::{Leaf, Signed, Value};
use crate::graph::Number;

/// The numbers that a function computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Numbers {
    /// Those of a scalar.
    Plain,
    /// Numbers of any kind, such as intervals.
    Exact,
    /// Those of a lane, without branches.
    InLanes,
}

/// Values, and facts about them, by id.
#[derive(Debug)]
pub(super) struct Values {
    pub(super) all: Vec<Value>,
    /// True if a statement binds the value, or if it is an argument.
    pub(super) is_bound: Vec<bool>,
    /// True if the value, as it is bound or written, is the negative of what formulas mean by it.
    pub(super) is_negative: Vec<bool>,
    /// True once the signs in the value are settled.
    pub(super) is_settled: Vec<bool>,
    /// The value that a symbol is another name of.
    stands_for: Vec<Option<ValueId>>,
    /// The number of the last step that the value depends on.
    known: Vec<usize>,
    pub(super) numbers: Numbers,
}

impl Values {
    /// No values.
    pub(super) fn new(numbers: Numbers) -> Self {
        let [is_bound, is_negative, is_settled] = [const { Vec::new() }; 3];
        Self { all: Vec::new(), is_bound, is_negative, is_settled, stands_for: Vec::new(), known: Vec::new(), numbers }
    }

    /// Adds the values of a schedule, and returns the number to add to their ids.
    pub(super) fn absorb(&mut self, values: Vec<Value>, known: Vec<usize>) -> usize {
        let (first, count) = (self.all.len(), self.all.len() + values.len());
        self.all.extend(values);
        self.known.extend(known);
        self.known.resize(count, 0);
        self.stands_for.resize(count, None);
        for facts in [&mut self.is_bound, &mut self.is_negative, &mut self.is_settled] {
            facts.resize(count, false);
        }
        first
    }

    /// Adds a value whose operands are settled.
    pub(super) fn add(&mut self, value: Value) -> ValueId {
        let is_leaf = matches!(value, Value::Given(Leaf::Itself) | Value::Given(Leaf::Argument(_)));
        self.all.push(value);
        self.is_bound.push(is_leaf);
        self.is_negative.push(false);
        self.is_settled.push(true);
        self.stands_for.push(None);
        self.known.push(0);
        ValueId::new(self.all.len() - 1)
    }

    /// Adds a value that a pattern binds.
    pub(super) fn bound(&mut self) -> ValueId {
        let id = self.add(Value::Given(Leaf::Bound));
        self.is_bound[id.index()] = true;
        id
    }

    /// Lets a symbol stand for a bound value.
    pub(super) fn alias(&mut self, symbol: ValueId, value: ValueId) {
        self.stands_for[symbol.index()] = Some(value);
        self.is_bound[symbol.index()] = true;
    }

    /// The value that this one stands for.
    pub(super) fn itself(&self, id: ValueId) -> ValueId {
        self.stands_for[id.index()].unwrap_or(id)
    }

    pub(super) fn number(&mut self, number: Number) -> ValueId {
        self.add(Value::Constant(number))
    }

    /// A settled value or its negative.
    pub(super) fn written(&mut self, signed: Signed) -> ValueId {
        if signed.negative { self.add(Value::Negative(signed.value)) } else { signed.value }
    }

    pub(super) fn get(&self, id: ValueId) -> &Value {
        &self.all[id.index()]
    }

    /// True if a value is known before another one.
    pub(super) fn is_earlier(&self, one: ValueId, other: ValueId) -> bool {
        self.known[one.index()] < self.known[other.index()]
    }

    pub(super) fn last_step(&self, id: ValueId) -> usize {
        self.known[id.index()]
    }

    pub(super) fn uses(&self) -> Uses<'_> {
        Uses { values: &self.all, is_bound: &self.is_bound }
    }

    /// True if a value is neither bound nor zero nor one.
    pub(super) fn is_formula(&self, id: ValueId) -> bool {
        match self.get(id) {
            _ if self.is_bound[id.index()] => false,
            Value::Constant(number) => !number.is_zero() && !number.is_one(),
            _ => true,
        }
    }
}
