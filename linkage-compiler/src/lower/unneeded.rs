//! Statements that nothing needs.

use linkage_ir::ValueId;
use linkage_ir::code::Returned;
use rustc_hash::{FxHashMap, FxHashSet};

use super::value::{Pattern, Statement, Value};
use super::values::Values;

/// Removes `let`s with unused names, unless they may fail; adds the values that the others use.
pub(super) fn needed(values: &Values, statements: Vec<Statement>, used: &mut FxHashSet<ValueId>) -> Vec<Statement> {
    let mut kept = Vec::new();
    for statement in statements.into_iter().rev() {
        let is_unused = match &statement {
            Statement::Let(Pattern::Typed(bound, _) | Pattern::Bound(bound), value) => {
                !matches!(values.get(*value), Value::Try(_)) && !used.contains(bound)
            }
            _ => false,
        };
        if !is_unused {
            values.uses().statement(&statement, &mut |id| {
                used.insert(id);
            });
            kept.push(statement);
        }
    }
    kept.reverse();
    kept
}

/// Takes the value of a call apart where it is computed, if nothing else uses its name:
/// `let Rates { theta3, .. } = coordinate_rates(…);`.
pub(super) fn taken_apart_at_once(values: &mut Values, statements: Vec<Statement>, value: Returned) -> Vec<Statement> {
    let mut uses: FxHashMap<ValueId, usize> = FxHashMap::default();
    let mut count = |id| *uses.entry(id).or_default() += 1;
    values.uses().value(value.returned(), &mut count);
    values.uses().statements(&statements, &mut count);
    // Arguments are taken apart in a statement of their own.
    let is_bound = |bound: &ValueId| {
        statements
            .iter()
            .any(|statement| matches!(statement, Statement::Let(Pattern::Bound(other), _) if other == bound))
    };
    let apart = statements.iter().filter_map(|statement| match statement {
        Statement::Let(pattern @ (Pattern::Struct { .. } | Pattern::List(_) | Pattern::Tuple(_)), of)
            if values.is_bound[of.index()] && uses[of] == 1 && is_bound(of) =>
        {
            Some((*of, pattern.clone()))
        }
        _ => None,
    });
    let apart: FxHashMap<ValueId, Pattern> = apart.collect();
    let statements = statements.into_iter().filter_map(|statement| match statement {
        Statement::Let(Pattern::Bound(bound), value) => {
            let pattern = apart.get(&bound).cloned();
            // The value has no name any more.
            values.is_bound[bound.index()] &= pattern.is_none() || bound != value;
            Some(Statement::Let(pattern.unwrap_or(Pattern::Bound(bound)), value))
        }
        Statement::Let(_, of) if apart.contains_key(&of) => None,
        statement => Some(statement),
    });
    statements.collect()
}

/// Returns the value of the last `let` instead of its name, if the function returns that name.
pub(super) fn unnamed(values: &mut Values, statements: &mut Vec<Statement>, value: Returned) -> Returned {
    let is_named = |statement: &mut Statement| match (statement, value) {
        (Statement::Let(Pattern::Bound(last), _), Returned::Plain(value)) => *last == value,
        _ => false,
    };
    match statements.pop_if(is_named) {
        Some(Statement::Let(Pattern::Bound(bound), last)) => {
            values.is_bound[bound.index()] &= bound != last;
            Returned::Plain(last)
        }
        _ => value,
    }
}
