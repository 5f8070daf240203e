//! The values that get a line of their own, in the order of their lines.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::{FxHashMap, FxHashSet};

use super::schedule::{Circular, Line};
use super::value::{Signed, Value, ValueId};
use crate::graph::{ExternalId, Function, Graph, SymbolId};

/// An inline expression nested deeper than this is hard to read; it gets a line of its own.
const DEEPEST_INLINE: usize = 5;

/// As many angles have their sines and cosines taken in one vector operation.
const SIDE_BY_SIDE: usize = 4;

/// Decides which values get a line, and in what order.
pub(super) struct Ordering {
    pub(super) values: Vec<Value>,
    uses: Vec<usize>,
    /// The nesting of a value written inline; zero once it has a name.
    height: Vec<Option<usize>>,
    pub(super) lines: Vec<Line>,
    /// The sines and cosines that are used, by their angles and the signs of these.
    circular: BTreeMap<(ValueId, bool), Circular>,
    /// The value and the derivatives that are used of each user function, by its arguments.
    externals: FxHashMap<(ExternalId, Vec<Signed>), Vec<Option<ValueId>>>,
}

impl Ordering {
    pub(super) fn new(graph: &Graph, values: Vec<Value>, roots: &[Signed]) -> Self {
        let (mut uses, mut height) = (vec![0; values.len()], vec![None; values.len()]);
        let (mut circular, mut externals) = (BTreeMap::new(), FxHashMap::default());
        let mut stack: Vec<ValueId> = roots.iter().map(|root| root.value).collect();
        while let Some(id) = stack.pop() {
            uses[id.0] += 1;
            if uses[id.0] > 1 {
                continue;
            }
            let value = &values[id.0];
            match value {
                Value::Symbol(_) | Value::Direction(..) | Value::Constant(_) => height[id.0] = Some(0),
                Value::Call(function @ (Function::Sin | Function::Cos), arguments) => {
                    let angle = arguments[0];
                    let empty = Circular { angle, sine: None, cosine: None };
                    let one = circular.entry((angle.value, angle.negative)).or_insert(empty);
                    match function {
                        Function::Sin => one.sine = Some(id),
                        _ => one.cosine = Some(id),
                    }
                }
                Value::External(external, arguments) => {
                    let given = graph.external_names(external.function).len();
                    let call = (external.function, arguments.clone());
                    let call = externals.entry(call).or_insert_with(|| vec![None; given]);
                    if let Some(place) = external.order().and_then(|order| call.get_mut(order)) {
                        *place = Some(id);
                    }
                }
                _ => {}
            }
            value.each_part(|part| stack.push(part));
        }
        Self { height, values, uses, lines: Vec::new(), circular, externals }
    }

    /// Every value that the roots depend on, ascending.
    pub(super) fn used(&self) -> Vec<ValueId> {
        (0..self.uses.len()).filter(|&index| self.uses[index] > 0).map(ValueId).collect()
    }

    /// Emits the lines that `root` depends on; `named` if its own line is about to follow.
    pub(super) fn require(&mut self, root: ValueId, named: bool) {
        let mut stack = vec![(root, false)];
        while let Some((id, expanded)) = stack.pop() {
            let (values, heights) = (&self.values, &self.height);
            if heights[id.0].is_some() {
                continue;
            }
            let value = &values[id.0];
            if !expanded {
                stack.push((id, true));
                let first = stack.len();
                value.each_part(|part| {
                    if heights[part.0].is_none() {
                        stack.push((part, false));
                    }
                });
                // The first part is to come out first.
                stack[first..].reverse();
                continue;
            }
            if named && id == root && !matches!(value, Value::External(..)) && self.paired(id).is_none() {
                self.height[id.0] = Some(0);
                continue;
            }
            let mut height = 0;
            value.each_part(|part| {
                if let Some(inside) = heights[part.0] {
                    height = height.max(inside + 1);
                }
            });
            let deserves = self.uses[id.0] > 1 || height > DEEPEST_INLINE;
            self.height[id.0] = Some(if self.pair(id) || self.call(id) {
                0
            } else if deserves {
                self.lines.push(Line::Let(id));
                0
            } else {
                height
            });
        }
    }

    /// Takes the sines and cosines of all angles that are known from the start together: side by side
    /// they cost half as much as one by one.
    pub(super) fn gather_sines(&mut self, introduced: &BTreeSet<SymbolId>) {
        let mut known = FxHashSet::default();
        let several = self.circular.values().filter(|one| self.is_known(one.angle.value, introduced, &mut known));
        let mut several: Vec<Circular> = several.copied().collect();
        // The last of five stands beside none: a sine without its cosine costs less by itself.
        if several.len() % SIDE_BY_SIDE == 1
            && let Some(alone) = several.iter().rposition(|one| !one.is_pair())
        {
            several.remove(alone);
        }
        if several.len() < 2 {
            return;
        }
        for one in &several {
            self.require(one.angle.value, false);
            self.give_names(one);
        }
        self.lines.push(Line::SinesCosines(several));
    }

    /// True if a value depends on nothing that the kernel itself solves for, and on no sine; values that are `known`
    /// are looked at once.
    fn is_known(&self, value: ValueId, introduced: &BTreeSet<SymbolId>, known: &mut FxHashSet<ValueId>) -> bool {
        let (mut seen, mut stack) = (FxHashSet::default(), vec![value]);
        while let Some(id) = stack.pop() {
            if known.contains(&id) || !seen.insert(id) {
                continue;
            }
            match &self.values[id.0] {
                Value::Symbol(symbol) if introduced.contains(symbol) => return false,
                Value::Call(Function::Sin | Function::Cos, _) => return false,
                _ => self.values[id.0].each_part(|part| stack.push(part)),
            }
        }
        known.extend(seen);
        true
    }

    /// The sine and cosine of one angle, of which this value is one, if both are used.
    fn paired(&self, id: ValueId) -> Option<Circular> {
        let Value::Call(Function::Sin | Function::Cos, arguments) = &self.values[id.0] else { return None };
        let angle = arguments[0];
        self.circular.get(&(angle.value, angle.negative)).copied().filter(Circular::is_pair)
    }

    /// Writes sine and cosine of one angle as one line, if both are used.
    fn pair(&mut self, id: ValueId) -> bool {
        let Some(pair) = self.paired(id) else { return false };
        self.give_names(&pair);
        self.lines.push(Line::SineCosine(pair));
        true
    }

    /// Marks what is used as named by the line that follows.
    fn give_names(&mut self, one: &Circular) {
        for value in one.sine.into_iter().chain(one.cosine) {
            self.height[value.0] = Some(0);
        }
    }

    /// Writes all that is used of a user function as one call.
    fn call(&mut self, id: ValueId) -> bool {
        let Value::External(external, arguments) = &self.values[id.0] else { return false };
        let (function, arguments) = (external.function, arguments.clone());
        let values = self.externals.get(&(function, arguments.clone())).cloned().unwrap_or_default();
        for value in values.iter().flatten() {
            self.height[value.0] = Some(0);
        }
        self.lines.push(Line::External { function, arguments, values });
        true
    }
}
