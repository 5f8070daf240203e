//! The order of factors in a product: numbers, shared products, symbols in the order of declaration, sines and cosines,
//! other functions, sums, quotients.

use linkage_ir::ValueId;

use super::value::{Leaf, Value};
use crate::graph::SymbolId;

/// The sort key of a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Number,
    /// A product that begins with this symbol, or its square.
    Made(SymbolId),
    Symbol(SymbolId),
    Direction,
    Function,
    Sum,
    Quotient,
}

/// Sorts the factors of all products.
pub(super) fn order(values: &mut [Value]) {
    let mut kinds: Vec<Option<Kind>> = vec![None; values.len()];
    for id in 0..values.len() {
        settle(values, &mut kinds, ValueId::new(id));
    }
    for value in values {
        if let Value::Product(factors) = value {
            factors.sort_by_key(|&factor| (kinds[factor.index()], factor));
        }
    }
}

/// Finds the sort key of a value, after those of its factors.
fn settle(values: &[Value], kinds: &mut [Option<Kind>], root: ValueId) {
    let mut stack = vec![root];
    while let Some(&id) = stack.last() {
        let factors: Vec<ValueId> = match &values[id.index()] {
            Value::Product(factors) => factors.clone(),
            Value::Square(base) => vec![*base],
            _ => Vec::new(),
        };
        let open = factors.iter().copied().find(|factor| kinds[factor.index()].is_none());
        if let Some(open) = open.filter(|_| kinds[id.index()].is_none()) {
            stack.push(open);
            continue;
        }
        stack.pop();
        kinds[id.index()] = Some(match &values[id.index()] {
            Value::Constant(_) => Kind::Number,
            Value::Given(Leaf::Symbol(symbol)) => Kind::Symbol(*symbol),
            Value::Given(Leaf::Direction(..)) => Kind::Direction,
            Value::Sum(_) => Kind::Sum,
            Value::Quotient(..) => Kind::Quotient,
            Value::Product(_) | Value::Square(_) => {
                let kinds = factors.iter().filter_map(|factor| kinds[factor.index()]);
                match kinds.filter(|kind| *kind != Kind::Number).min() {
                    Some(Kind::Symbol(first)) => Kind::Made(first),
                    first => first.unwrap_or(Kind::Number),
                }
            }
            _ => Kind::Function,
        });
    }
}
