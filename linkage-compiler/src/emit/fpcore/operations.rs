//! The operations of straight-line code, in the order of computation.

use std::collections::BTreeMap;

use linkage_ir::code::Value;
use linkage_ir::{Slot, ValueId};

use crate::ids::Table;
use crate::program::CheckKind;

/// A condition of the code on numbers, by its word.
#[derive(Debug)]
pub(super) struct Check {
    pub(super) kind: CheckKind,
    /// It holds for the results that depend on the first.
    pub(super) of: Vec<ValueId>,
}

/// Numbers and arithmetic; an argument is a bound value.
#[derive(Debug, Default)]
pub(super) struct Operations {
    all: Table<ValueId, (Value, Option<String>)>,
    /// The arguments by role and name.
    arguments: BTreeMap<(usize, String), ValueId>,
}

impl Operations {
    pub(super) fn add(&mut self, operation: Value) -> ValueId {
        self.all.push((operation, None))
    }

    /// The argument of a role with this key, which gets this name if it is new.
    pub(super) fn argument(&mut self, key: (usize, String), name: &str) -> ValueId {
        if let Some(id) = self.arguments.get(&key) {
            return *id;
        }
        let id = self.all.push((Value::Given(Slot::ITSELF), Some(name.to_owned())));
        self.arguments.insert(key, id);
        id
    }

    /// The argument with this key, if the code uses it.
    pub(super) fn known(&self, key: &(usize, String)) -> Option<ValueId> {
        self.arguments.get(key).copied()
    }

    /// Gives a result its name in the code, unless it has one.
    pub(super) fn name(&mut self, id: ValueId, name: &str) {
        self.all[id].1.get_or_insert_with(|| name.to_owned());
    }

    pub(super) fn operation(&self, id: ValueId) -> &Value {
        &self.all[id].0
    }

    /// True for an argument or a number, which is no operation.
    pub(super) fn is_leaf(&self, id: ValueId) -> bool {
        matches!(self.operation(id), Value::Given(_) | Value::Constant(_) | Value::Turn(..))
    }

    /// Visits the operands of an operation, each as often as it is written.
    pub(super) fn each_operand(&self, id: ValueId, mut visit: impl FnMut(ValueId)) {
        if let Value::Square(base) = self.operation(id) {
            visit(*base);
        }
        self.operation(id).each_part(visit);
    }

    pub(super) fn preferred(&self, id: ValueId) -> Option<&str> {
        self.all[id].1.as_deref()
    }

    /// The number of operations and arguments.
    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// All of them, in the order of computation.
    pub(super) fn ids(&self) -> impl DoubleEndedIterator<Item = ValueId> + use<> {
        (0..self.all.len()).map(ValueId::new)
    }
}
