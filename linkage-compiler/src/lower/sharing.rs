//! Sums that share two terms share their sum, products that share two factors share their product:
//! the most frequent pair first, until no pair occurs twice.
//!
//! This is the greedy elimination of two-term common subexpressions (A. Hosangadi, F. Fallah,
//! R. Kastner, "Optimizing polynomial expressions by algebraic factorization and common subexpression
//! elimination", IEEE TCAD 25, 2006). A new pair is never more frequent than the one that it comes from,
//! so that the pairs are gone through by their frequency once; what is out of date is put back.
//!
//! It ends because no part stands twice in a list: a pair is then held once a list, what takes its place makes
//! the list shorter by one, and pairs are only held again by a list that has become shorter.

use super::{Signed, Value, ValueId};
use crate::budget::Budget;
use crate::places::{Hash, Places};

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
pub(super) fn share(values: &mut Vec<Value>, roots: &[Signed], budget: &Budget) {
    let mut seen = vec![false; values.len()].into_boxed_slice();
    let mut stack = Vec::with_capacity(2 * roots.len());
    for root in roots {
        stack.push(root.value);
    }
    while let Some(id) = stack.pop() {
        if !std::mem::replace(&mut seen[id.0], true) {
            values[id.0].each_part(|part| stack.push(part));
        }
    }
    for kind in [Kind::Sums, Kind::Products] {
        let mut lists = Vec::new();
        let (all, mut next) = (values.as_slice(), 0);
        while next < seen.len() {
            let index = next;
            next += 1;
            let parts = match (kind, &all[index]) {
                (Kind::Sums, Value::Sum(terms)) if seen[index] => terms.clone(),
                (Kind::Products, Value::Product(factors)) if seen[index] => {
                    factors.iter().map(|&value| Signed { negative: false, value }).collect()
                }
                _ => continue,
            };
            lists.push(List { value: ValueId(index), parts, is_new: false });
        }
        if lists.len() > 1 {
            Sharing::new(kind, lists, values.len(), budget).run(values);
        }
    }
}

struct Sharing<'a> {
    kind: Kind,
    budget: &'a Budget,
    lists: Vec<List>,
    /// Which parts stand in several lists, or may come to, being lists themselves: a pair with any
    /// other part is held once at most.
    frequent: Box<[bool]>,
    /// The places of the lists that hold a pair.
    holders: Vec<(Pair, Holders)>,
    places: Places,
    /// The pairs held by as many lists, each as often as it came to be.
    frequencies: Vec<Vec<Pair>>,
}

/// The places of lists; most pairs are held by one only.
struct Holders {
    first: Option<usize>,
    others: Vec<usize>,
}

impl Holders {
    const NONE: Self = Self { first: None, others: Vec::new() };

    fn iter(&self) -> impl Iterator<Item = usize> {
        self.first.iter().chain(&self.others).copied()
    }

    fn len(&self) -> usize {
        usize::from(self.first.is_some()) + self.others.len()
    }

    /// How many there are now.
    fn add(&mut self, place: usize) -> usize {
        if self.first.is_none() {
            self.first = Some(place);
        } else {
            self.others.push(place);
        }
        self.len()
    }

    fn remove(&mut self, place: usize) {
        if self.first == Some(place) {
            self.first = (!self.others.is_empty()).then(|| self.others.remove(0));
        } else {
            self.others.retain(|&other| other != place);
        }
    }
}

impl<'a> Sharing<'a> {
    fn new(kind: Kind, lists: Vec<List>, values: usize, budget: &'a Budget) -> Self {
        let [mut met, mut frequent] = [(); 2].map(|()| vec![false; values].into_boxed_slice());
        for list in &lists {
            frequent[list.value.0] = true;
            for part in &list.parts {
                frequent[part.value.0] |= std::mem::replace(&mut met[part.value.0], true);
            }
        }
        let (holders, places, frequencies) = (Vec::new(), Places::default(), Vec::new());
        Self { kind, budget, lists, frequent, holders, places, frequencies }
    }

    fn run(mut self, values: &mut Vec<Value>) {
        let mut pairs = Vec::new();
        for place in 0..self.lists.len() {
            self.pairs(place, &mut pairs);
            for &pair in &pairs {
                self.hold(pair, place);
            }
        }
        while let Some(mut equal) = self.frequencies.pop() {
            let count = self.frequencies.len();
            // Of pairs equally frequent the oldest is taken, so that the result does not depend on chance.
            in_order(&mut equal);
            self.frequencies.push(Vec::new());
            let mut next = 0;
            while next < equal.len() && !self.budget.is_spent() {
                let pair = equal[next];
                next += 1;
                let Some(index) = self.find(pair) else { continue };
                let now = self.holders[index].1.len();
                if now < count {
                    if now > 1 {
                        self.frequencies[now].push(pair);
                    }
                    continue;
                }
                let of = std::mem::replace(&mut self.holders[index].1, Holders::NONE);
                self.merge(pair, &of, values, &mut pairs);
                // What has come to be as frequent stands in line with the others.
                for new in std::mem::take(&mut self.frequencies[count]) {
                    let place = next + equal[next..].partition_point(|&other| other < new);
                    equal.insert(place, new);
                }
            }
            self.frequencies.pop();
        }
        for List { value, parts, .. } in self.lists.into_iter().filter(|list| list.is_new) {
            values[value.0] = match self.kind {
                Kind::Sums => Value::Sum(parts),
                Kind::Products => Value::Product(parts.into_iter().map(|part| part.value).collect()),
            };
        }
    }

    /// Puts one sum or product in place of a pair in all lists that hold it.
    fn merge(&mut self, pair: Pair, of: &Holders, values: &mut Vec<Value>, pairs: &mut Vec<Pair>) {
        let whole = of.iter().map(|place| &self.lists[place]).find(|list| list.parts.len() == 2);
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
        for place in of.iter() {
            let List { value, parts, .. } = &self.lists[place];
            // A list that holds the shared value and its parts keeps both.
            if *value != shared && parts.iter().all(|part| part.value != shared) {
                self.replace(place, pair, shared, sign, pairs);
            }
        }
    }

    /// Puts the shared pair into a list in place of its two parts.
    fn replace(&mut self, place: usize, pair: Pair, shared: ValueId, sign: bool, pairs: &mut Vec<Pair>) {
        let is_long = self.lists[place].parts.len() > LONGEST_PAIRED;
        // Of a short list the pairs of what stays stay.
        let touches = |pair: Pair, value: ValueId| pair.first() == value || pair.second() == value;
        self.pairs(place, pairs);
        for &other in pairs.iter() {
            if (is_long || touches(other, pair.first()) || touches(other, pair.second()))
                && let Some(index) = self.find(other)
            {
                self.holders[index].1.remove(place);
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
        self.pairs(place, pairs);
        for &other in pairs.iter() {
            if is_long || touches(other, shared) {
                self.hold(other, place);
            }
        }
    }

    fn find(&self, pair: Pair) -> Option<usize> {
        self.places.find(Hash::of(pair.0), |index| self.holders[index].0 == pair)
    }

    fn hold(&mut self, pair: Pair, place: usize) {
        let index = self.find(pair).unwrap_or_else(|| {
            self.places.insert(Hash::of(pair.0), self.holders.len());
            self.holders.push((pair, Holders::NONE));
            self.holders.len() - 1
        });
        let count = self.holders[index].1.add(place);
        if count > 1 {
            if self.frequencies.len() <= count {
                self.frequencies.resize(count + 1, Vec::new());
            }
            self.frequencies[count].push(pair);
        }
    }

    /// The pairs of a list. No part stands twice in it: equal factors are a square, equal terms have a coefficient.
    fn pairs(&self, place: usize, pairs: &mut Vec<Pair>) {
        pairs.clear();
        let parts = self.lists[place].parts.as_slice();
        self.budget.spend(parts.len());
        let reach = if parts.len() > LONGEST_PAIRED { 1 } else { parts.len() };
        let mut first = 0;
        while first < parts.len() {
            let (a, mut second) = (parts[first], first + 1);
            let end = if self.is_frequent(a) { parts.len().min(second + reach) } else { second };
            while second < end {
                if self.is_frequent(parts[second]) {
                    pairs.push(Pair::new(a, parts[second]));
                }
                second += 1;
            }
            first += 1;
        }
    }

    fn is_frequent(&self, part: Signed) -> bool {
        // What is shared already stands wherever its pair stood.
        part.value.0 >= self.frequent.len() || self.frequent[part.value.0]
    }
}

/// Sorts pairs: a thousand, which is more than most kernels have, by Shell's method with the gaps of M. Ciura ("Best
/// increments for the average case of shellsort", FCT 2001), since unoptimised the library's spends its time on calls.
fn in_order(pairs: &mut [Pair]) {
    const MANY: usize = 1000;
    if pairs.len() > MANY {
        pairs.sort_unstable();
        return;
    }
    for gap in [301, 132, 57, 23, 10, 4, 1] {
        let mut sorted = gap;
        while sorted < pairs.len() {
            let (pair, mut place) = (pairs[sorted], sorted);
            while place >= gap && pairs[place - gap].0 > pair.0 {
                pairs[place] = pairs[place - gap];
                place -= gap;
            }
            pairs[place] = pair;
            sorted += 1;
        }
    }
}

fn sign_of(parts: &[Signed], value: ValueId) -> bool {
    parts.iter().any(|part| part.value == value && part.negative)
}
