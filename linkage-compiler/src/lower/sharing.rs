//! Sums that share two terms share their sum, products that share two factors share their product:
//! the most frequent pair first, until no pair occurs twice.
//!
//! This is the greedy elimination of two-term common subexpressions (A. Hosangadi, F. Fallah,
//! R. Kastner, "Optimizing polynomial expressions by algebraic factorization and common subexpression
//! elimination", IEEE TCAD 25, 2006). The pairs wait in a heap by their frequency; one that has become less frequent is
//! put back. Of pairs equally frequent the components of links come first, l cos theta and l sin theta: taken out before
//! products of lengths, they save half a percent of all multiplications, and functions that call each other compute the
//! same products.
//!
//! It ends because no part stands twice in a list: a pair is then held once a list, what takes its place makes
//! the list shorter by one, and pairs are only held again by a list that has become shorter.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::value::{Signed, Value, ValueId};
use crate::budget::Budget;
use crate::graph::Function;

/// The longest sum or product of which all parts are paired; of a longer one neighbours are, since the pairs of a
/// list grow with the square of its length.
const LONGEST_PAIRED: usize = 8;

/// Two parts of one list, the older first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Pair {
    first: ValueId,
    second: ValueId,
    /// True if their signs differ.
    opposed: bool,
}

impl Pair {
    fn new(a: Signed, b: Signed) -> Self {
        let opposed = a.negative != b.negative;
        Self { first: a.value.min(b.value), second: a.value.max(b.value), opposed }
    }

    fn holds(self, value: ValueId) -> bool {
        self.first == value || self.second == value
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sums,
    Products,
}

/// A sum or product.
struct List {
    value: ValueId,
    parts: Vec<Signed>,
    is_new: bool,
}

/// Rewrites the sums and products that `roots` depend on until no two of them share a pair.
pub(super) fn share(values: &mut Vec<Value>, roots: &[Signed], budget: &Budget) {
    let mut is_used = vec![false; values.len()];
    let mut stack: Vec<ValueId> = roots.iter().map(|root| root.value).collect();
    while let Some(id) = stack.pop() {
        if !std::mem::replace(&mut is_used[id.0], true) {
            values[id.0].each_part(|part| stack.push(part));
        }
    }
    for kind in [Kind::Sums, Kind::Products] {
        let used = values.iter().zip(&is_used).enumerate().filter(|(_, (_, is_used))| **is_used);
        let lists = used.filter_map(|(index, (value, _))| {
            let parts = match (kind, value) {
                (Kind::Sums, Value::Sum(terms)) => terms.clone(),
                (Kind::Products, Value::Product(factors)) => {
                    factors.iter().map(|&value| Signed { negative: false, value }).collect()
                }
                _ => return None,
            };
            Some(List { value: ValueId(index), parts, is_new: false })
        });
        Sharing::new(kind, lists.collect(), values, budget).run(values);
    }
}

struct Sharing<'a> {
    kind: Kind,
    budget: &'a Budget,
    lists: Vec<List>,
    /// True of the parts that stand in several lists, or may come to, being lists themselves: a pair with any
    /// other part is held once at most.
    frequent: Vec<bool>,
    /// The places of the lists that hold a pair.
    holders: FxHashMap<Pair, Vec<usize>>,
    /// The pairs that more than one list held when they came to be, with the number of lists, and whether they are a
    /// component of a link. Of pairs equally frequent the oldest comes first, so that the result does not depend on
    /// chance.
    candidates: BinaryHeap<(usize, bool, Reverse<Pair>)>,
    /// The symbols, and the sines and cosines among the values.
    factors: Vec<Factor>,
}

/// A factor of a component of a link.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Factor {
    Symbol,
    Circular,
    Other,
}

impl Factor {
    fn of(value: &Value) -> Self {
        match value {
            Value::Symbol(_) => Self::Symbol,
            Value::Direction(..) | Value::Call(Function::Sin | Function::Cos, _) => Self::Circular,
            _ => Self::Other,
        }
    }
}

impl<'a> Sharing<'a> {
    fn new(kind: Kind, lists: Vec<List>, values: &[Value], budget: &'a Budget) -> Self {
        let (mut met, mut frequent) = (vec![false; values.len()], vec![false; values.len()]);
        for list in &lists {
            frequent[list.value.0] = true;
            for part in &list.parts {
                frequent[part.value.0] |= std::mem::replace(&mut met[part.value.0], true);
            }
        }
        let factors = values.iter().map(Factor::of).collect();
        Self { kind, budget, lists, frequent, holders: FxHashMap::default(), candidates: BinaryHeap::new(), factors }
    }

    fn run(mut self, values: &mut Vec<Value>) {
        for place in 0..self.lists.len() {
            for pair in self.pairs(place) {
                self.hold(pair, place);
            }
        }
        while let Some((count, is_component, Reverse(pair))) = self.candidates.pop()
            && !self.budget.is_spent()
        {
            let now = self.holders.get(&pair).map_or(0, Vec::len);
            if now == count {
                let of = self.holders.remove(&pair).unwrap_or_default();
                self.merge(pair, &of, values);
            } else if now > 1 {
                self.candidates.push((now, is_component, Reverse(pair)));
            }
        }
        for List { value, parts, .. } in self.lists.into_iter().filter(|list| list.is_new) {
            values[value.0] = match self.kind {
                Kind::Sums => Value::Sum(parts),
                Kind::Products => Value::Product(parts.into_iter().map(|part| part.value).collect()),
            };
        }
    }

    /// Puts one sum or product in place of a pair in all lists that hold it.
    fn merge(&mut self, pair: Pair, of: &[usize], values: &mut Vec<Value>) {
        let whole = of.iter().map(|&place| &self.lists[place]).find(|list| list.parts.len() == 2);
        // The sign with which the older part stands in the shared sum.
        let (shared, sign) = match whole {
            Some(whole) => (whole.value, sign_of(&whole.parts, pair.first)),
            None => {
                let second = Signed { negative: pair.opposed, value: pair.second };
                values.push(match self.kind {
                    Kind::Sums => Value::Sum(vec![Signed { negative: false, value: pair.first }, second]),
                    Kind::Products => Value::Product(vec![pair.first, pair.second]),
                });
                (ValueId(values.len() - 1), false)
            }
        };
        for &place in of {
            let List { value, parts, .. } = &self.lists[place];
            // A list that holds the shared value and its parts keeps both.
            if *value != shared && parts.iter().all(|part| part.value != shared) {
                self.replace(place, pair, shared, sign);
            }
        }
    }

    /// Puts the shared pair into a list in place of its two parts.
    fn replace(&mut self, place: usize, pair: Pair, shared: ValueId, sign: bool) {
        // Of a short list the pairs of what stays stay.
        let is_long = self.lists[place].parts.len() > LONGEST_PAIRED;
        for other in self.pairs(place) {
            if (is_long || other.holds(pair.first) || other.holds(pair.second))
                && let Some(holders) = self.holders.get_mut(&other)
            {
                holders.retain(|&holder| holder != place);
            }
        }
        let List { parts, is_new, .. } = &mut self.lists[place];
        let negative = sign_of(parts, pair.first) != sign;
        parts.retain(|part| !pair.holds(part.value));
        // The shared part leads; of a sum, what is added stands before what is taken away.
        parts.insert(0, Signed { negative, value: shared });
        if negative {
            parts.sort_by_key(|part| part.negative);
        }
        *is_new = true;
        for other in self.pairs(place) {
            if is_long || other.holds(shared) {
                self.hold(other, place);
            }
        }
    }

    fn hold(&mut self, pair: Pair, place: usize) {
        let holders = self.holders.entry(pair).or_default();
        holders.push(place);
        let count = holders.len();
        if count > 1 {
            self.candidates.push((count, self.is_component(pair), Reverse(pair)));
        }
    }

    /// True of a length, or another symbol, by a sine or cosine.
    fn is_component(&self, pair: Pair) -> bool {
        let factors = [pair.first, pair.second].map(|value| self.factors.get(value.0));
        self.kind == Kind::Products
            && factors.contains(&Some(&Factor::Symbol))
            && factors.contains(&Some(&Factor::Circular))
    }

    /// The pairs of a list. No part stands twice in it: equal factors are a square, equal terms have a coefficient.
    fn pairs(&self, place: usize) -> Vec<Pair> {
        let parts = &self.lists[place].parts;
        self.budget.spend(parts.len());
        let reach = if parts.len() > LONGEST_PAIRED { 1 } else { parts.len() };
        let mut pairs = Vec::new();
        for (index, &a) in parts.iter().enumerate().filter(|(_, a)| self.is_frequent(**a)) {
            let others = parts[index + 1..].iter().take(reach).filter(|b| self.is_frequent(**b));
            pairs.extend(others.map(|&b| Pair::new(a, b)));
        }
        pairs
    }

    fn is_frequent(&self, part: Signed) -> bool {
        // What is shared already stands wherever its pair stood.
        self.frequent.get(part.value.0).is_none_or(|is_frequent| *is_frequent)
    }
}

fn sign_of(parts: &[Signed], value: ValueId) -> bool {
    parts.iter().any(|part| part.value == value && part.negative)
}
