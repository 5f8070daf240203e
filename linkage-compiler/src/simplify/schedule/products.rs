//! Products that share two factors share their product: the most frequent pair first.

use std::collections::{BTreeMap, BTreeSet};

use super::{Value, ValueId};

/// Rewrites the products that `roots` stand on until no two of them share a pair of factors.
pub(super) fn share(values: &mut Vec<Value>, roots: &[ValueId]) {
    let mut products: BTreeMap<ValueId, Vec<ValueId>> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if seen.insert(id) {
            stack.extend(values[id.0].parts());
            if let Value::Product(factors) = &values[id.0] {
                products.insert(id, factors.clone());
            }
        }
    }
    // Which products hold a pair; pairs are in ascending order.
    let mut holders: BTreeMap<(ValueId, ValueId), BTreeSet<ValueId>> = BTreeMap::new();
    for (&product, factors) in &products {
        for pair in pairs(factors) {
            holders.entry(pair).or_default().insert(product);
        }
    }
    // Of pairs equally frequent the oldest is taken, so that the result does not depend on chance.
    while let Some((&(a, b), _)) =
        holders.iter().filter(|(_, of)| of.len() > 1).max_by_key(|(pair, of)| (of.len(), std::cmp::Reverse(**pair)))
    {
        let of = holders.remove(&(a, b)).unwrap_or_default();
        let whole = of.iter().copied().find(|product| products[product].len() == 2);
        let shared = whole.unwrap_or_else(|| {
            values.push(Value::Product(vec![a, b]));
            ValueId(values.len() - 1)
        });
        products.entry(shared).or_insert_with(|| vec![a, b]);
        for product in of.into_iter().filter(|product| *product != shared) {
            let before = products[&product].clone();
            for pair in pairs(&before) {
                if let Some(of) = holders.get_mut(&pair) {
                    of.remove(&product);
                }
            }
            let mut after = before;
            for taken in [a, b] {
                if let Some(index) = after.iter().position(|factor| *factor == taken) {
                    after.remove(index);
                }
            }
            // The shared part leads, where its first factor stood.
            after.insert(0, shared);
            for pair in pairs(&after) {
                holders.entry(pair).or_default().insert(product);
            }
            products.insert(product, after);
        }
    }
    for (id, factors) in products {
        values[id.0] = Value::Product(factors);
    }
}

fn pairs(factors: &[ValueId]) -> BTreeSet<(ValueId, ValueId)> {
    let mut pairs = BTreeSet::new();
    for (index, &a) in factors.iter().enumerate() {
        pairs.extend(factors[index + 1..].iter().map(|&b| (a.min(b), a.max(b))));
    }
    pairs
}
