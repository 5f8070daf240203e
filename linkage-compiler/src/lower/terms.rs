//! The order of terms in a sum: those that are known first come first, so that little is left to do when the last one is
//! there.

use linkage_ir::ValueId;
use rustc_hash::FxHashMap;

use super::value::{Leaf, Signed, Value};
use crate::derivation::Step;
use crate::graph::SymbolId;

/// Sorts the terms of all sums by the last step that they depend on, and returns its number for each value: zero for values
/// that are known at the beginning.
pub(super) fn order(values: &mut [Value], steps: &[Step]) -> Vec<usize> {
    let mut introduced = FxHashMap::default();
    for (number, step) in steps.iter().enumerate() {
        introduced.extend(step.introduced().into_iter().map(|symbol| (symbol, number + 1)));
    }
    let mut known = vec![None; values.len()];
    for id in 0..values.len() {
        settle(values, &introduced, &mut known, ValueId::new(id));
    }
    let known: Vec<usize> = known.into_iter().map(Option::unwrap_or_default).collect();
    for value in values {
        if let Value::Sum(terms) = value {
            sort(terms, |id| known[id.index()], |term| term.negative);
        }
    }
    known
}

/// Sorts terms by the last step that they depend on, but begins with a positive one, to avoid a leading minus.
pub(super) fn sort(terms: &mut [Signed], known: impl Fn(ValueId) -> usize, is_negative: impl Fn(&Signed) -> bool) {
    // The order of two terms saves nothing.
    let is_long = terms.len() > 2;
    terms.sort_by_key(|term| (is_long.then(|| known(term.value)), is_negative(term)));
    if let Some(first) = terms.iter().position(|term| !is_negative(term)) {
        terms[..=first].rotate_right(1);
    }
}

/// Finds the last step that a value depends on, after those of its parts.
fn settle(values: &[Value], introduced: &FxHashMap<SymbolId, usize>, known: &mut [Option<usize>], root: ValueId) {
    let mut stack = vec![root];
    while let Some(&id) = stack.last() {
        let (mut open, mut last) = (None, 0);
        values[id.index()].each_part(|part| match known[part.index()] {
            Some(step) => last = last.max(step),
            None => open = Some(part),
        });
        if let Some(open) = open {
            stack.push(open);
            continue;
        }
        stack.pop();
        if let Value::Given(Leaf::Symbol(symbol)) = &values[id.index()] {
            last = introduced.get(symbol).copied().unwrap_or_default();
        }
        known[id.index()] = Some(last);
    }
}
