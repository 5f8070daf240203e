//! Ordering: the values that get a line of their own, and the order of the lines.

use std::collections::{BTreeMap, BTreeSet};

use linkage_ir::ValueId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::schedule::{Circular, Line};
use super::value::{Leaf, Signed, Value};
use crate::graph::{ExternalId, Function, Graph, SymbolId};

/// The largest nesting of an inline expression; deeper ones get a line, for readability.
const DEEPEST_INLINE: usize = 5;

/// The number of angles in one vector operation of sines and cosines.
const SIDE_BY_SIDE: usize = 4;

/// Decides which values get a line, and in what order.
pub(super) struct Ordering {
    pub(super) values: Vec<Value>,
    uses: Vec<usize>,
    /// The values that are squared: x * x needs a name.
    squared: Vec<bool>,
    /// The nesting depth of a value; zero if it has a name, `None` before it is ordered.
    height: Vec<Option<usize>>,
    pub(super) lines: Vec<Line>,
    /// The sines and cosines that are used, by angle and its sign.
    circular: BTreeMap<(ValueId, bool), Circular>,
    /// The values and derivatives that are used of each user function, by its arguments.
    externals: FxHashMap<(ExternalId, Vec<Signed>), Vec<Option<ValueId>>>,
}

impl Ordering {
    pub(super) fn new(graph: &Graph, values: Vec<Value>, roots: &[Signed]) -> Self {
        let (mut uses, mut squared) = (vec![0; values.len()], vec![false; values.len()]);
        let mut height = vec![None; values.len()];
        let (mut circular, mut externals) = (BTreeMap::new(), FxHashMap::default());
        let mut stack: Vec<ValueId> = roots.iter().map(|root| root.value).collect();
        while let Some(id) = stack.pop() {
            uses[id.index()] += 1;
            if uses[id.index()] > 1 {
                continue;
            }
            let value = &values[id.index()];
            match value {
                Value::Given(Leaf::Symbol(_)) | Value::Given(Leaf::Direction(..)) | Value::Constant(_) => {
                    height[id.index()] = Some(0)
                }
                Value::Call(function @ (Function::Sin | Function::Cos), arguments) => {
                    let angle = arguments[0];
                    let empty = Circular { angle, sine: None, cosine: None };
                    let one = circular.entry((angle.value, angle.negative)).or_insert(empty);
                    match function {
                        Function::Sin => one.sine = Some(id),
                        _ => one.cosine = Some(id),
                    }
                }
                Value::Given(Leaf::External(external, arguments)) => {
                    let given = graph.external_names(external.function).len();
                    let call = (external.function, arguments.clone());
                    let call = externals.entry(call).or_insert_with(|| vec![None; given]);
                    if let Some(index) = external.order().and_then(|order| call.get_mut(order)) {
                        *index = Some(id);
                    }
                }
                Value::Square(base) => squared[base.index()] = true,
                _ => {}
            }
            value.each_part(|part| stack.push(part));
        }
        Self { height, values, uses, squared, lines: Vec::new(), circular, externals }
    }

    /// Every value that the roots depend on, ascending.
    pub(super) fn used(&self) -> Vec<ValueId> {
        (0..self.uses.len()).filter(|&index| self.uses[index] > 0).map(ValueId::new).collect()
    }

    /// True if a value is used more than once.
    pub(super) fn is_shared(&self, value: ValueId) -> bool {
        self.uses[value.index()] > 1
    }

    /// Adds the lines that `root` depends on; `named` if the caller adds the line of `root` itself.
    pub(super) fn require(&mut self, root: ValueId, named: bool) {
        let mut stack = vec![(root, false)];
        while let Some((id, expanded)) = stack.pop() {
            let (values, heights) = (&self.values, &self.height);
            if heights[id.index()].is_some() {
                continue;
            }
            let value = &values[id.index()];
            if !expanded {
                stack.push((id, true));
                let first = stack.len();
                value.each_part(|part| {
                    if heights[part.index()].is_none() {
                        stack.push((part, false));
                    }
                });
                // Reversed, so that the first operand is popped first.
                stack[first..].reverse();
                continue;
            }
            if named && id == root && !matches!(value, Value::Given(Leaf::External(..))) && self.paired(id).is_none() {
                self.height[id.index()] = Some(0);
                continue;
            }
            let mut height = 0;
            value.each_part(|part| {
                if let Some(inside) = heights[part.index()] {
                    height = height.max(inside + 1);
                }
            });
            let deserves = self.uses[id.index()] > 1 || self.squared[id.index()] || height > DEEPEST_INLINE;
            self.height[id.index()] = Some(if self.pair(id) || self.call(id) {
                0
            } else if deserves {
                self.lines.push(Line::Let(id));
                0
            } else {
                height
            });
        }
    }

    /// Adds one line for the sines and cosines of all angles known at the start: in vector operations they cost half as
    /// much as one by one. They come first, where they have the registers for themselves, also those of a single angle,
    /// and one that is computed separately. A single sine or cosine stays where it is used.
    pub(super) fn gather_sines(&mut self, introduced: &BTreeSet<SymbolId>) {
        let mut known = FxHashSet::default();
        let several = self.circular.values().filter(|one| self.is_known(one.angle.value, introduced, &mut known));
        let mut several: Vec<Circular> = several.copied().collect();
        if let [one] = several.as_slice()
            && !one.is_pair()
        {
            return;
        }
        // A fifth angle needs a vector operation of its own: if some angle needs no pair, compute it separately.
        let is_fifth = several.len() % SIDE_BY_SIDE == 1;
        let alone = several.iter().rposition(|one| !one.is_pair()).filter(|_| is_fifth);
        let alone = alone.map(|index| several.remove(index));
        for one in &several {
            self.require(one.angle.value, false);
            self.give_names(one);
        }
        match several.as_slice() {
            [] => {}
            [one] => self.lines.push(Line::SineCosine(*one)),
            _ => self.lines.push(Line::SinesCosines(several)),
        }
        if let Some(value) = alone.and_then(|one| one.sine.or(one.cosine)) {
            self.require(value, true);
            self.lines.push(Line::Let(value));
        }
    }

    /// True if a value depends neither on results of steps nor on a sine or cosine; `known` caches values for which
    /// this is true.
    fn is_known(&self, value: ValueId, introduced: &BTreeSet<SymbolId>, known: &mut FxHashSet<ValueId>) -> bool {
        let (mut seen, mut stack) = (FxHashSet::default(), vec![value]);
        while let Some(id) = stack.pop() {
            if known.contains(&id) || !seen.insert(id) {
                continue;
            }
            match &self.values[id.index()] {
                Value::Given(Leaf::Symbol(symbol)) if introduced.contains(symbol) => return false,
                Value::Call(Function::Sin | Function::Cos, _) => return false,
                _ => self.values[id.index()].each_part(|part| stack.push(part)),
            }
        }
        known.extend(seen);
        true
    }

    /// The sine-cosine pair of a value, if the value is one of them and both are used.
    fn paired(&self, id: ValueId) -> Option<Circular> {
        let Value::Call(Function::Sin | Function::Cos, arguments) = &self.values[id.index()] else { return None };
        let angle = arguments[0];
        self.circular.get(&(angle.value, angle.negative)).copied().filter(Circular::is_pair)
    }

    /// Adds one line for a sine-cosine pair, if both are used; returns true then.
    fn pair(&mut self, id: ValueId) -> bool {
        let Some(pair) = self.paired(id) else { return false };
        self.give_names(&pair);
        self.lines.push(Line::SineCosine(pair));
        true
    }

    /// Marks the sine and cosine as named.
    fn give_names(&mut self, one: &Circular) {
        for value in one.sine.into_iter().chain(one.cosine) {
            self.height[value.index()] = Some(0);
        }
    }

    /// Adds one line for the value and all derivatives of a user function; returns true then.
    fn call(&mut self, id: ValueId) -> bool {
        let Value::Given(Leaf::External(external, arguments)) = &self.values[id.index()] else { return false };
        let (function, arguments) = (external.function, arguments.clone());
        let values = self.externals.get(&(function, arguments.clone())).cloned().unwrap_or_default();
        for value in values.iter().flatten() {
            self.height[value.index()] = Some(0);
        }
        self.lines.push(Line::External { function, arguments, values });
        true
    }
}
