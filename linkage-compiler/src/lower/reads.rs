//! Reads: where the fields of arguments are read.

use linkage_ir::ValueId;
use rustc_hash::FxHashSet;

use super::value::{Pattern, Statement, Value, bound_by};
use super::values::Values;
use crate::program::Type;

/// Reads a field that is only passed on, such as the position of a slider, where it is passed on: `q.s`.
pub(super) fn passed_on(values: &mut Values, statements: &mut Vec<Statement>, results: &mut [ValueId]) {
    let mut used: FxHashSet<ValueId> = FxHashSet::default();
    values.uses().statements(statements, &mut |id| {
        used.insert(id);
    });
    for result in results.iter().filter(|result| !values.is_bound[result.index()]) {
        values.uses().inside(*result, &mut |id| {
            used.insert(id);
        });
    }
    statements.retain_mut(|statement| {
        let Statement::Let(Pattern::Struct { fields, is_whole, .. }, of) = statement else { return true };
        let Value::Dereferenced(of) = values.get(*of) else { return true };
        let (of, count) = (*of, fields.len());
        fields.retain(|(field, pattern)| {
            let Pattern::Bound(bound) = pattern else { return true };
            let is_used = used.contains(bound);
            if !is_used {
                for result in results.iter_mut().filter(|result| *result == bound) {
                    *result = values.add(Value::Field(of, *field));
                }
            }
            is_used
        });
        *is_whole &= fields.len() == count;
        !fields.is_empty()
    });
}

/// Moves the statement that reads the parameters to their first use: what is computed before, such as the sines of the
/// inputs, then has the registers for itself.
pub(super) fn parameters_where_used(values: &Values, statements: &mut Vec<Statement>) {
    let is_parameters =
        |statement: &Statement| matches!(statement, Statement::Let(Pattern::Struct { of: Type::Itself, .. }, _));
    let Some(index) = statements.iter().position(is_parameters) else { return };
    let parameters = statements.remove(index);
    let bound: FxHashSet<ValueId> = bound_by(&parameters).into_iter().collect();
    let uses = |statement: &Statement| {
        let mut is_used = false;
        values.uses().statement(statement, &mut |id| is_used |= bound.contains(&id));
        is_used
    };
    let index = statements.iter().position(uses).unwrap_or(statements.len());
    statements.insert(index, parameters);
}
