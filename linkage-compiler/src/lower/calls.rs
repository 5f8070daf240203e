//! The functions that code calls.

use linkage_ir::ValueId;
use linkage_ir::code::{Callee, Returned};
use rustc_hash::FxHashSet;

use super::code::Draft;
use super::value::{Block, Statement, Value};

impl Draft {
    /// The functions of the program that it calls, once for each call.
    pub fn calls(&self) -> Vec<Callee> {
        calls(&self.values, &self.statements, self.value, false)
    }
}

/// The functions of the program that statements and a returned value always call, once for each call: not those that an
/// inner function calls, as often as it is called itself, nor those of an early return.
pub(super) fn always(values: &[Value], statements: &[Statement], value: Returned) -> Vec<Callee> {
    calls(values, statements, value, true)
}

fn calls(values: &[Value], statements: &[Statement], value: Returned, only_always: bool) -> Vec<Callee> {
    let mut found = Calls { values, only_always, seen: FxHashSet::default(), all: Vec::new() };
    found.statements(statements);
    match value {
        Returned::Plain(value) | Returned::Result(value) => found.value(value),
        Returned::Stored { result, literal } => [result, literal].into_iter().for_each(|value| found.value(value)),
    }
    found.all
}

struct Calls<'a> {
    values: &'a [Value],
    only_always: bool,
    seen: FxHashSet<ValueId>,
    all: Vec<Callee>,
}

impl Calls<'_> {
    fn statements(&mut self, statements: &[Statement]) {
        for statement in statements {
            match statement {
                Statement::Store(inside) => self.statements(std::slice::from_ref(inside)),
                Statement::Let(_, value) | Statement::Do(value) | Statement::Return(value) => self.value(*value),
                Statement::Assign(one, other) => [one, other].into_iter().for_each(|value| self.value(*value)),
                Statement::LetElse(_, value, otherwise) => {
                    self.value(*value);
                    if !self.only_always {
                        self.value(*otherwise);
                    }
                }
                Statement::Unless(conditions, inside) => {
                    conditions.iter().for_each(|condition| self.value(*condition));
                    if !self.only_always {
                        self.statements(inside);
                    }
                }
            }
        }
    }

    fn value(&mut self, id: ValueId) {
        let mut stack = vec![id];
        while let Some(id) = stack.pop() {
            if !self.seen.insert(id) {
                continue;
            }
            let values = self.values;
            let value = &values[id.index()];
            match value {
                Value::Closure { .. } if self.only_always => {}
                Value::Closure { body, .. } | Value::Block(body) => self.block(body),
                Value::Own(receiver, function, _) => self.all.push(receiver.callee(*function)),
                _ => {}
            }
            value.each_part(|part| stack.push(part));
        }
    }

    fn block(&mut self, block: &Block) {
        self.statements(&block.statements);
        self.value(block.value);
    }
}
