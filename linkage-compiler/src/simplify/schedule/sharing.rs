//! Sums that share two terms share their sum, products that share two factors share their product:
//! the most frequent pair first, until no pair occurs twice.
//!
//! This is the greedy elimination of two-term common subexpressions (A. Hosangadi, F. Fallah,
//! R. Kastner, "Optimizing polynomial expressions by algebraic factorization and common subexpression
//! elimination", IEEE TCAD 25, 2006). A queue holds the pairs by frequency; what is out of date is put
//! back, so that the work grows with the number of pairs.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::{Signed, Value, ValueId};

/// Of a sum or product of more parts than this only neighbours are paired: the pairs of a list grow
/// with the square of its length.
const LONGEST_PAIRED: usize = 8;

/// Two parts of one list, the older first, and whether their signs differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Pair {
    first: ValueId,
    second: ValueId,
    opposed: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sums,
    Products,
}

/// The parts of every sum, or of every product.
type Lists = FxHashMap<ValueId, Vec<Signed>>;

/// Rewrites the sums and products that `roots` stand on until no two of them share a pair.
pub(super) fn share(values: &mut Vec<Value>, roots: &[ValueId]) {
    let (mut sums, mut products) = (Lists::default(), Lists::default());
    let mut seen = vec![false; values.len()];
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if std::mem::replace(&mut seen[id.0], true) {
            continue;
        }
        match &values[id.0] {
            Value::Sum(terms) => drop(sums.insert(id, terms.clone())),
            Value::Product(factors) => {
                let plain = |&value: &ValueId| Signed { negative: false, value };
                products.insert(id, factors.iter().map(plain).collect());
            }
            _ => {}
        }
        values[id.0].each_part(|part| stack.push(part));
    }
    for (kind, lists) in [(Kind::Sums, sums), (Kind::Products, products)] {
        if lists.len() > 1 {
            Sharing::new(kind, lists).run(values);
        }
    }
}

struct Sharing {
    kind: Kind,
    lists: Lists,
    /// Which lists hold a pair.
    holders: FxHashMap<Pair, Vec<ValueId>>,
    queue: BinaryHeap<(usize, Reverse<Pair>)>,
}

impl Sharing {
    fn new(kind: Kind, lists: Lists) -> Self {
        let mut ordered: Vec<ValueId> = lists.keys().copied().collect();
        ordered.sort_unstable();
        let mut holders: FxHashMap<Pair, Vec<ValueId>> = FxHashMap::default();
        for list in ordered {
            for pair in pairs(&lists[&list]) {
                holders.entry(pair).or_default().push(list);
            }
        }
        let frequent = holders.iter().filter(|(_, of)| of.len() > 1);
        let queue = frequent.map(|(&pair, of)| (of.len(), Reverse(pair))).collect();
        Self { kind, lists, holders, queue }
    }

    fn run(mut self, values: &mut Vec<Value>) {
        // Of pairs equally frequent the oldest is taken, so that the result does not depend on chance.
        while let Some((count, Reverse(pair))) = self.queue.pop() {
            let now = self.holders.get(&pair).map_or(0, Vec::len);
            if now < count {
                if now > 1 {
                    self.queue.push((now, Reverse(pair)));
                }
                continue;
            }
            let of = self.holders.remove(&pair).unwrap_or_default();
            let whole = of.iter().copied().find(|list| self.lists[list].len() == 2);
            let shared = whole.unwrap_or_else(|| {
                let parts = [pair.first, pair.second];
                let second = Signed { negative: pair.opposed, value: pair.second };
                values.push(match self.kind {
                    Kind::Sums => Value::Sum(vec![Signed { negative: false, value: pair.first }, second]),
                    Kind::Products => Value::Product(parts.to_vec()),
                });
                ValueId(values.len() - 1)
            });
            // The sign with which the older part stands in the shared sum.
            let sign = whole.is_some_and(|whole| sign_of(&self.lists[&whole], pair.first));
            for list in of.into_iter().filter(|list| *list != shared) {
                self.replace(list, pair, shared, sign);
            }
        }
        for (id, parts) in self.lists {
            values[id.0] = match self.kind {
                Kind::Sums => Value::Sum(parts),
                Kind::Products => Value::Product(parts.into_iter().map(|part| part.value).collect()),
            };
        }
    }

    /// Puts the shared pair into a list in place of its two parts.
    fn replace(&mut self, list: ValueId, pair: Pair, shared: ValueId, sign: bool) {
        let Some(mut parts) = self.lists.remove(&list) else { return };
        for other in pairs(&parts) {
            if let Some(of) = self.holders.get_mut(&other)
                && let Some(index) = of.iter().position(|holder| *holder == list)
            {
                of.remove(index);
            }
        }
        let negative = sign_of(&parts, pair.first) != sign;
        for taken in [pair.first, pair.second] {
            if let Some(index) = parts.iter().position(|part| part.value == taken) {
                parts.remove(index);
            }
        }
        // The shared part leads; of a sum, what is added stands before what is taken away.
        parts.insert(0, Signed { negative, value: shared });
        parts.sort_by_key(|part| part.negative);
        for other in pairs(&parts) {
            let of = self.holders.entry(other).or_default();
            of.push(list);
            if of.len() > 1 {
                self.queue.push((of.len(), Reverse(other)));
            }
        }
        self.lists.insert(list, parts);
    }
}

fn sign_of(parts: &[Signed], value: ValueId) -> bool {
    parts.iter().any(|part| part.value == value && part.negative)
}

/// No part stands twice in a list: equal factors are a square, equal terms have a coefficient.
fn pairs(parts: &[Signed]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (index, a) in parts.iter().enumerate() {
        let reach = if parts.len() > LONGEST_PAIRED { 2 } else { parts.len() };
        for b in parts.iter().take(index + reach).skip(index + 1) {
            let opposed = a.negative != b.negative;
            let pair = Pair { first: a.value.min(b.value), second: a.value.max(b.value), opposed };
            pairs.push(pair);
        }
    }
    pairs
}
