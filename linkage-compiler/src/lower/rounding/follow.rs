//! One pass over the values of a schedule.

use linkage_ir::ValueId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::super::schedule::{Line, Schedule};
use super::super::value::{Leaf, Signed, Value};
use super::Roundings;
use super::monomial::Factor;
use super::tracked::Tracked;
use crate::graph::{Function, Graph, SymbolId};

/// The values of one kernel.
pub(super) struct Following<'a> {
    graph: &'a Graph,
    schedule: &'a Schedule,
    known: &'a mut Roundings,
    /// The values that symbols of this kernel name; `None` for a solution of Newton's method and the like.
    named: FxHashMap<SymbolId, Option<Signed>>,
    of: Vec<Option<Option<Tracked>>>,
}

impl<'a> Following<'a> {
    pub(super) fn new(graph: &'a Graph, schedule: &'a Schedule, known: &'a mut Roundings) -> Self {
        let mut named = FxHashMap::default();
        for line in &schedule.lines {
            match line {
                Line::Name { symbol, value } => {
                    named.insert(*symbol, Some(*value));
                }
                Line::Turn { symbol, .. } | Line::Chord { symbol, .. } | Line::Pivots { symbol, .. } => {
                    named.insert(*symbol, None);
                }
                Line::Solve { targets, .. } | Line::Newton { targets, .. } | Line::Modes { targets, .. } => {
                    named.extend(targets.iter().map(|target| (*target, None)));
                }
                _ => {}
            }
        }
        Self { graph, schedule, known, named, of: vec![None; schedule.values.len()] }
    }

    /// The error of a value with its sign; `None` if it is unknown.
    pub(super) fn signed(&mut self, signed: Signed) -> Option<Tracked> {
        self.visit(signed.value);
        self.known(signed)
    }

    fn known(&self, signed: Signed) -> Option<Tracked> {
        let value = self.of[signed.value.index()].clone().flatten()?;
        Some(if signed.negative { value.negative() } else { value })
    }

    /// Operands first.
    fn visit(&mut self, root: ValueId) {
        let mut stack = vec![(root, false)];
        let mut entered = FxHashSet::default();
        while let Some((id, is_ready)) = stack.pop() {
            if self.of[id.index()].is_some() {
                continue;
            }
            // Names may be circular if the budget was exceeded.
            if is_ready || !entered.insert(id) {
                self.of[id.index()] = Some(self.value(id));
                continue;
            }
            stack.push((id, true));
            let schedule = self.schedule;
            match schedule.value(id) {
                Value::Given(Leaf::Symbol(symbol)) => {
                    stack.extend(self.named.get(symbol).copied().flatten().map(|value| (value.value, false)));
                }
                value => value.each_part(|part| stack.push((part, false))),
            }
        }
    }

    fn value(&mut self, id: ValueId) -> Option<Tracked> {
        let schedule = self.schedule;
        match schedule.value(id) {
            Value::Given(Leaf::Symbol(symbol)) => match (self.named.get(symbol), self.known.pose.get(symbol)) {
                (Some(value), _) => self.known((*value)?),
                (None, Some(of_pose)) => of_pose.clone(),
                (None, None) => Some(Tracked::stored(Factor::Symbol(*symbol))),
            },
            Value::Given(Leaf::Direction(function, angle)) => {
                let angle = self.known.angles.of_node(self.graph, *angle)?;
                Tracked::sine(&self.known.angles, *function == Function::Sin, angle)
            }
            Value::Constant(number) => Tracked::constant(*number),
            Value::Sum(terms) => {
                let terms: Vec<Tracked> = terms.iter().map(|term| self.known(*term)).collect::<Option<_>>()?;
                Tracked::sum(&mut self.known.angles, &terms)
            }
            Value::Product(factors) => {
                let factors: Vec<Tracked> = factors.iter().map(|factor| self.part(*factor)).collect::<Option<_>>()?;
                Tracked::product(&factors)
            }
            Value::Quotient(above, below) => self.part(*above)?.over(&self.part(*below)?),
            Value::Square(base) => self.part(*base)?.square(),
            Value::Call(function @ (Function::Sin | Function::Cos), angle) => {
                if self.has_computed(*angle.first()?) {
                    return None;
                }
                let angle = self.known.angles.of_value(schedule, *angle.first()?)?;
                Tracked::sine(&self.known.angles, *function == Function::Sin, angle)
            }
            Value::Call(Function::Sqrt, inside) => self.known(*inside.first()?)?.root(),
            Value::Call(Function::Abs, inside) => Some(self.known(*inside.first()?)?.magnitude()),
            _ => None,
        }
    }

    fn part(&self, value: ValueId) -> Option<Tracked> {
        self.known(Signed { negative: false, value })
    }

    /// True if an angle is not a sum of arguments.
    fn has_computed(&self, angle: Signed) -> bool {
        let is_computed = |id: ValueId| matches!(self.schedule.value(id), Value::Given(Leaf::Symbol(symbol)) if self.named.contains_key(symbol));
        let mut any = is_computed(angle.value);
        self.schedule.value(angle.value).each_part(|part| any |= is_computed(part));
        any
    }
}
