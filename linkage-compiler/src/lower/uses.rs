//! Uses: the bound values, arguments among them, that statements read.

use linkage_ir::ValueId;

use super::value::{Block, Pattern, Statement, Value};

/// The values of a function, and which of them a statement binds.
#[derive(Clone, Copy)]
pub(super) struct Uses<'a> {
    pub(super) values: &'a [Value],
    pub(super) is_bound: &'a [bool],
}

impl Uses<'_> {
    /// Visits every bound value that a statement reads.
    pub(super) fn statement(&self, statement: &Statement, visit: &mut dyn FnMut(ValueId)) {
        match statement {
            // A pattern that binds its value gives it a name.
            Statement::Let(pattern, value) => match *pattern {
                Pattern::Bound(bound) if bound == *value => self.inside(*value, visit),
                _ => self.value(*value, visit),
            },
            Statement::Do(value) | Statement::Return(value) => self.value(*value, visit),
            Statement::Assign(one, other) | Statement::LetElse(_, one, other) => {
                self.value(*one, visit);
                self.value(*other, visit);
            }
            Statement::Store(inside) => self.statement(inside, visit),
            Statement::Unless(conditions, inside) => {
                conditions.iter().for_each(|condition| self.value(*condition, visit));
                self.statements(inside, visit);
            }
        }
    }

    pub(super) fn statements(&self, statements: &[Statement], visit: &mut dyn FnMut(ValueId)) {
        statements.iter().for_each(|statement| self.statement(statement, visit));
    }

    /// Visits a bound value, or every one that another value is computed from.
    pub(super) fn value(&self, id: ValueId, visit: &mut dyn FnMut(ValueId)) {
        if self.is_bound[id.index()] { visit(id) } else { self.inside(id, visit) }
    }

    /// Visits every bound value that a value is computed from.
    pub(super) fn inside(&self, id: ValueId, visit: &mut dyn FnMut(ValueId)) {
        match &self.values[id.index()] {
            Value::Closure { body, .. } | Value::Block(body) => self.block(body, visit),
            value => value.each_part(|part| self.value(part, visit)),
        }
    }

    fn block(&self, body: &Block, visit: &mut dyn FnMut(ValueId)) {
        self.statements(&body.statements, visit);
        self.value(body.value, visit);
    }

    /// True if a value reads one of these.
    pub(super) fn reads(&self, id: ValueId, mut is_it: impl FnMut(ValueId) -> bool) -> bool {
        let mut found = false;
        self.value(id, &mut |used| found |= is_it(used));
        found
    }
}
