//! Common subexpression elimination in sums and products: greedily replaces the most frequent pair of operands by a new
//! value, until no pair occurs twice.
//!
//! This is the elimination of two-term common subexpressions by A. Hosangadi, F. Fallah, R. Kastner, "Optimizing
//! polynomial expressions by algebraic factorization and common subexpression elimination", IEEE TCAD 25, 2006. The
//! pairs are in a heap by frequency; a pair that has become less frequent is put back. Among equally frequent pairs the
//! components of links, l cos theta and l sin theta, come first. This saves half a percent of all multiplications
//! compared with products of two lengths first, and functions that call each other then compute the same products.
//!
//! It terminates: no operand occurs twice in a list, so that each replacement of a pair makes a list shorter, and new
//! pairs come only from lists that have become shorter.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use linkage_ir::ValueId;
use rustc_hash::FxHashMap;

use super::value::{Leaf, Signed, Value, is_circular};
use crate::budget::Budget;

/// The longest sum or product in which all pairs of operands are considered; in a longer one only neighbours are, since
/// the number of pairs grows with the square of the length.
const LONGEST_PAIRED: usize = 8;

/// Two operands of one list, the older first.
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

/// The operands of a sum or product.
struct List {
    /// The sum or product.
    value: ValueId,
    parts: Vec<Signed>,
    /// True if a pair of the operands has been replaced.
    is_changed: bool,
}

/// Rewrites the sums and products that `roots` depend on until no two of them have a pair of operands in common.
///
/// A kernel that is inlined into other functions has the components of all its links, even those used once, since these
/// functions have them too.
pub(super) fn share(values: &mut Vec<Value>, roots: &[Signed], budget: &Budget, is_inlined: bool) {
    let mut is_used = vec![false; values.len()];
    let mut stack: Vec<ValueId> = roots.iter().map(|root| root.value).collect();
    while let Some(id) = stack.pop() {
        if !std::mem::replace(&mut is_used[id.index()], true) {
            values[id.index()].each_part(|part| stack.push(part));
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
            Some(List { value: ValueId::new(index), parts, is_changed: false })
        });
        let keeps_components = is_inlined && kind == Kind::Products;
        Sharing::new(kind, lists.collect(), values, budget, keeps_components).run(values);
    }
}

struct Sharing<'a> {
    kind: Kind,
    budget: &'a Budget,
    /// True if each component of a link is a product, even if it is used once.
    keeps_components: bool,
    lists: Vec<List>,
    /// True for operands that occur in several lists or are lists themselves; a pair with any other operand occurs at
    /// most once.
    frequent: Vec<bool>,
    /// The lists that contain a pair, by index.
    holders: FxHashMap<Pair, Vec<usize>>,
    /// The pairs to replace by their priority, with their frequency when they were added. Among equals the oldest pair
    /// comes first, so that the result is deterministic.
    candidates: BinaryHeap<(Priority, Reverse<Pair>)>,
    /// The kind of each value as a factor, to recognise components of links.
    factors: Vec<Factor>,
}

/// The priority of a pair.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Priority {
    /// True if it is replaced even if no list shares it.
    is_kept: bool,
    /// The number of lists that contain it.
    count: usize,
    is_component: bool,
}

impl Priority {
    fn is_worthwhile(self) -> bool {
        self.count > 1 || (self.is_kept && self.count > 0)
    }
}

/// The kind of a factor: a component of a link is the product of a symbol and a sine or cosine.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Factor {
    Symbol,
    Circular,
    Other,
}

impl Factor {
    fn of(value: &Value, values: &[Value]) -> Self {
        match value {
            Value::Given(Leaf::Symbol(_)) => Self::Symbol,
            circular if is_circular(circular, values) => Self::Circular,
            _ => Self::Other,
        }
    }
}

impl<'a> Sharing<'a> {
    fn new(kind: Kind, lists: Vec<List>, values: &[Value], budget: &'a Budget, keeps_components: bool) -> Self {
        let (mut met, mut frequent) = (vec![false; values.len()], vec![keeps_components; values.len()]);
        for list in &lists {
            frequent[list.value.index()] = true;
            for part in &list.parts {
                frequent[part.value.index()] |= std::mem::replace(&mut met[part.value.index()], true);
            }
        }
        let factors = values.iter().map(|value| Factor::of(value, values)).collect();
        let (holders, candidates) = (FxHashMap::default(), BinaryHeap::new());
        Self { kind, budget, keeps_components, lists, frequent, holders, candidates, factors }
    }

    fn run(mut self, values: &mut Vec<Value>) {
        for place in 0..self.lists.len() {
            for pair in self.pairs(place) {
                self.record(pair, place);
            }
        }
        while let Some((priority, Reverse(pair))) = self.candidates.pop()
            && self.budget.check().is_ok()
        {
            let now = Priority { count: self.holders.get(&pair).map_or(0, Vec::len), ..priority };
            if now == priority {
                let holders = self.holders.remove(&pair).unwrap_or_default();
                self.merge(pair, &holders, values);
            } else if now.is_worthwhile() {
                self.candidates.push((now, Reverse(pair)));
            }
        }
        for List { value, parts, .. } in self.lists.into_iter().filter(|list| list.is_changed) {
            values[value.index()] = match self.kind {
                Kind::Sums => Value::Sum(parts),
                Kind::Products => Value::Product(parts.into_iter().map(|part| part.value).collect()),
            };
        }
    }

    /// Replaces a pair by one sum or product in all lists that contain it.
    fn merge(&mut self, pair: Pair, holders: &[usize], values: &mut Vec<Value>) {
        let whole = holders.iter().map(|&place| &self.lists[place]).find(|list| list.parts.len() == 2);
        // The value of the pair, and true if its older operand is negative in it.
        let (shared, is_first_negative) = match whole {
            Some(whole) => (whole.value, is_negative(&whole.parts, pair.first)),
            None => {
                let second = Signed { negative: pair.opposed, value: pair.second };
                values.push(match self.kind {
                    Kind::Sums => Value::Sum(vec![Signed { negative: false, value: pair.first }, second]),
                    Kind::Products => Value::Product(vec![pair.first, pair.second]),
                });
                (ValueId::new(values.len() - 1), false)
            }
        };
        for &place in holders {
            let List { value, parts, .. } = &self.lists[place];
            // A list must not contain the shared value twice.
            if *value != shared && parts.iter().all(|part| part.value != shared) {
                self.replace(place, pair, shared, is_first_negative);
            }
        }
    }

    /// Replaces a pair in one list by the shared value.
    fn replace(&mut self, place: usize, pair: Pair, shared: ValueId, is_first_negative: bool) {
        // In a short list only pairs with the replaced operands change.
        let is_long = self.lists[place].parts.len() > LONGEST_PAIRED;
        for other in self.pairs(place) {
            if (is_long || other.holds(pair.first) || other.holds(pair.second))
                && let Some(holders) = self.holders.get_mut(&other)
            {
                holders.retain(|&holder| holder != place);
            }
        }
        let List { parts, is_changed, .. } = &mut self.lists[place];
        let negative = is_negative(parts, pair.first) != is_first_negative;
        parts.retain(|part| !pair.holds(part.value));
        // The shared value comes first; in a sum, negative terms come last.
        parts.insert(0, Signed { negative, value: shared });
        if negative {
            parts.sort_by_key(|part| part.negative);
        }
        *is_changed = true;
        for other in self.pairs(place) {
            if is_long || other.holds(shared) {
                self.record(other, place);
            }
        }
    }

    /// Records that a list contains a pair.
    fn record(&mut self, pair: Pair, place: usize) {
        let holders = self.holders.entry(pair).or_default();
        holders.push(place);
        let count = holders.len();
        let is_component = self.is_component(pair);
        let priority = Priority { is_kept: is_component && self.keeps_components, count, is_component };
        if priority.is_worthwhile() {
            self.candidates.push((priority, Reverse(pair)));
        }
    }

    /// True for the product of a symbol, such as a length, and a sine or cosine.
    fn is_component(&self, pair: Pair) -> bool {
        let factors = [pair.first, pair.second].map(|value| self.factors.get(value.index()));
        self.kind == Kind::Products
            && factors.contains(&Some(&Factor::Symbol))
            && factors.contains(&Some(&Factor::Circular))
    }

    /// The pairs of a list. No operand occurs twice: equal factors form a square, equal terms have a coefficient.
    fn pairs(&self, place: usize) -> Vec<Pair> {
        let parts = &self.lists[place].parts;
        self.budget.count(parts.len());
        let reach = if parts.len() > LONGEST_PAIRED { 1 } else { parts.len() };
        let mut pairs = Vec::new();
        for (index, &a) in parts.iter().enumerate().filter(|(_, a)| self.is_frequent(**a)) {
            let others = parts[index + 1..].iter().take(reach).filter(|b| self.is_frequent(**b));
            pairs.extend(others.map(|&b| Pair::new(a, b)));
        }
        pairs
    }

    fn is_frequent(&self, part: Signed) -> bool {
        // Values made by sharing are frequent.
        self.frequent.get(part.value.index()).is_none_or(|is_frequent| *is_frequent)
    }
}

/// True if the value is an operand with a negative sign.
fn is_negative(parts: &[Signed], value: ValueId) -> bool {
    parts.iter().any(|part| part.value == value && part.negative)
}
