//! Sums that share two terms share their sum, products that share two factors share their product:
//! the most frequent pair first, until no pair occurs twice.
//!
//! This is the greedy elimination of two-term common subexpressions (A. Hosangadi, F. Fallah,
//! R. Kastner, "Optimizing polynomial expressions by algebraic factorization and common subexpression
//! elimination", IEEE TCAD 25, 2006). A queue holds the pairs by frequency; what is out of date is put
//! back, so that the work grows with the number of pairs.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::{Signed, Value, ValueId};

/// Of a sum or product of more parts than this only neighbours are paired: the pairs of a list grow
/// with the square of its length.
const LONGEST_PAIRED: usize = 8;

/// Two parts of one list, the older first, and whether their signs differ; packed, since pairs are
/// compared and looked up more than anything else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Pair(u64);

impl Pair {
    fn new(a: Signed, b: Signed) -> Self {
        let (first, second) = if a.value < b.value { (a.value, b.value) } else { (b.value, a.value) };
        Self(((first.0 as u64) << 32) | ((second.0 as u64) << 1) | u64::from(a.negative != b.negative))
    }

    fn first(self) -> ValueId {
        ValueId((self.0 >> 32) as usize)
    }

    fn second(self) -> ValueId {
        ValueId((self.0 as u32 >> 1) as usize)
    }

    fn opposed(self) -> bool {
        self.0 & 1 == 1
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

/// Rewrites the sums and products that `roots` stand on until no two of them share a pair.
pub(super) fn share(values: &mut Vec<Value>, roots: &[ValueId]) {
    let mut seen = vec![false; values.len()];
    let mut stack = roots.to_vec();
    while let Some(id) = stack.pop() {
        if !std::mem::replace(&mut seen[id.0], true) {
            values[id.0].each_part(|part| stack.push(part));
        }
    }
    for kind in [Kind::Sums, Kind::Products] {
        let mut lists = Vec::new();
        for (index, value) in values.iter().enumerate().take(seen.len()) {
            let parts = match (kind, value) {
                (Kind::Sums, Value::Sum(terms)) if seen[index] => terms.clone(),
                (Kind::Products, Value::Product(factors)) if seen[index] => {
                    factors.iter().map(|&value| Signed { negative: false, value }).collect()
                }
                _ => continue,
            };
            lists.push(List { value: ValueId(index), parts, is_new: false });
        }
        if lists.len() > 1 {
            Sharing::new(kind, lists, values.len()).run(values);
        }
    }
}

struct Sharing {
    kind: Kind,
    lists: Vec<List>,
    /// Which parts stand in several lists, or may come to, being lists themselves: a pair with any
    /// other part is held once at most.
    frequent: Vec<bool>,
    /// Which lists hold a pair, by their place.
    holders: FxHashMap<Pair, Vec<usize>>,
    queue: BinaryHeap<(usize, Reverse<Pair>)>,
}

impl Sharing {
    fn new(kind: Kind, lists: Vec<List>, values: usize) -> Self {
        let (mut met, mut frequent) = (vec![false; values], vec![false; values]);
        for list in &lists {
            frequent[list.value.0] = true;
            for part in &list.parts {
                frequent[part.value.0] |= std::mem::replace(&mut met[part.value.0], true);
            }
        }
        let count = lists.len();
        let mut sharing = Self {
            kind,
            lists,
            frequent,
            holders: FxHashMap::with_capacity_and_hasher(2 * count, FxBuildHasher),
            queue: BinaryHeap::new(),
        };
        for place in 0..sharing.lists.len() {
            for pair in sharing.pairs(place) {
                sharing.holders.entry(pair).or_default().push(place);
            }
        }
        for (&pair, of) in &sharing.holders {
            if of.len() > 1 {
                sharing.queue.push((of.len(), Reverse(pair)));
            }
        }
        sharing
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
            let whole = of.iter().map(|&place| &self.lists[place]).find(|list| list.parts.len() == 2);
            // The sign with which the older part stands in the shared sum.
            let (shared, sign) = match whole {
                Some(whole) => (whole.value, sign_of(&whole.parts, pair.first())),
                None => {
                    let second = Signed { negative: pair.opposed(), value: pair.second() };
                    values.push(match self.kind {
                        Kind::Sums => Value::Sum(vec![Signed { negative: false, value: pair.first() }, second]),
                        Kind::Products => Value::Product(vec![pair.first(), pair.second()]),
                    });
                    (ValueId(values.len() - 1), false)
                }
            };
            for place in of {
                if self.lists[place].value != shared {
                    self.replace(place, pair, shared, sign);
                }
            }
        }
        for List { value, parts, .. } in self.lists.into_iter().filter(|list| list.is_new) {
            values[value.0] = match self.kind {
                Kind::Sums => Value::Sum(parts),
                Kind::Products => Value::Product(parts.into_iter().map(|part| part.value).collect()),
            };
        }
    }

    /// Puts the shared pair into a list in place of its two parts.
    fn replace(&mut self, place: usize, pair: Pair, shared: ValueId, sign: bool) {
        for other in self.pairs(place) {
            if let Some(of) = self.holders.get_mut(&other)
                && let Some(index) = of.iter().position(|holder| *holder == place)
            {
                of.remove(index);
            }
        }
        let List { parts, is_new, .. } = &mut self.lists[place];
        let negative = sign_of(parts, pair.first()) != sign;
        parts.retain(|part| part.value != pair.first() && part.value != pair.second());
        // The shared part leads; of a sum, what is added stands before what is taken away.
        parts.insert(0, Signed { negative, value: shared });
        if negative {
            parts.sort_by_key(|part| part.negative);
        }
        *is_new = true;
        for other in self.pairs(place) {
            let of = self.holders.entry(other).or_default();
            of.push(place);
            if of.len() > 1 {
                self.queue.push((of.len(), Reverse(other)));
            }
        }
    }

    /// No part stands twice in a list: equal factors are a square, equal terms have a coefficient.
    fn pairs(&self, place: usize) -> Vec<Pair> {
        let parts = self.lists[place].parts.as_slice();
        // What is shared already stands wherever its pair stood.
        let frequent = |part: &Signed| self.frequent.get(part.value.0).is_none_or(|frequent| *frequent);
        let reach = if parts.len() > LONGEST_PAIRED { 1 } else { parts.len() };
        let mut pairs = Vec::new();
        for (index, a) in parts.iter().enumerate() {
            if !frequent(a) {
                continue;
            }
            for b in &parts[index + 1..parts.len().min(index + 1 + reach)] {
                if frequent(b) {
                    pairs.push(Pair::new(*a, *b));
                }
            }
        }
        pairs
    }
}

fn sign_of(parts: &[Signed], value: ValueId) -> bool {
    parts.iter().any(|part| part.value == value && part.negative)
}
