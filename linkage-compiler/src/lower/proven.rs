//! Finiteness analysis: results that need no `is_finite` check, since the checks of half chords imply that they are
//! finite.

use std::ops::Range;

use rustc_hash::FxHashMap;

use super::schedule::{Line, Schedule};
use super::value::{Value, ValueId};
use crate::graph::{Function, SymbolId};

impl Schedule {
    /// For each result, true if it is finite whenever all half chords pass their checks and the other results are
    /// finite.
    ///
    /// The check of a half chord requires that both factors are finite. In IEEE 754 a sum, product, square, square
    /// root, absolute value, sine or cosine is finite only if its operands are, so that these are finite, too.
    ///
    /// The `conclusive` results are checked, and whatever they are computed from is finite then.
    #[must_use]
    pub fn proven(&self, conclusive: Range<usize>) -> Vec<bool> {
        let results = &self.results;
        let is_chord = |line: &Line| matches!(line, Line::Chord { .. });
        if conclusive.is_empty() && !self.lines.iter().any(is_chord) {
            return vec![false; results.len()];
        }
        let mut proven = Proven {
            schedule: self,
            named: FxHashMap::default(),
            finite: vec![false; self.values.len()],
            checked: vec![false; self.values.len()],
        };
        let (mut chords, mut checked) = (Vec::new(), Vec::new());
        for line in &self.lines {
            match line {
                // The turn is an integer, so that an angle is finite if its principal value is.
                Line::Name { symbol, value } | Line::Turn { symbol, principal: value } => {
                    proven.named.insert(*symbol, value.value);
                }
                Line::Chord { symbol, factors, .. } => {
                    chords.push(*symbol);
                    checked.extend(factors.map(|factor| factor.value));
                }
                _ => {}
            }
        }
        proven.follow(checked);
        for result in &results[conclusive] {
            let operands = proven.operands(proven.itself(result.value));
            proven.follow(operands);
        }
        for &id in self.used() {
            if matches!(self.value(id), Value::Symbol(symbol) if chords.contains(symbol)) {
                proven.finite[id.0] = true;
            }
        }
        for result in results {
            let id = proven.itself(result.value);
            proven.checked[id.0] = true;
        }
        results.iter().map(|result| proven.is_finite(proven.itself(result.value))).collect()
    }
}

struct Proven<'a> {
    schedule: &'a Schedule,
    /// The value of each named symbol.
    named: FxHashMap<SymbolId, ValueId>,
    finite: Vec<bool>,
    /// True for results, which are checked.
    checked: Vec<bool>,
}

impl Proven<'_> {
    /// Marks these values and their operands as finite.
    fn follow(&mut self, mut stack: Vec<ValueId>) {
        while let Some(id) = stack.pop() {
            let id = self.itself(id);
            if std::mem::replace(&mut self.finite[id.0], true) {
                continue;
            }
            stack.extend(self.operands(id));
        }
    }

    /// The operands that are finite if a value is.
    fn operands(&self, id: ValueId) -> Vec<ValueId> {
        let mut operands = Vec::new();
        match self.schedule.value(id) {
            Value::Quotient(above, _) => operands.push(*above),
            value @ (Value::Call(Function::Abs | Function::Sqrt | Function::Sin | Function::Cos, _)
            | Value::Sum(_)
            | Value::Product(_)
            | Value::Square(_)) => value.each_part(|part| operands.push(part)),
            _ => {}
        }
        operands
    }

    fn is_finite(&self, id: ValueId) -> bool {
        let value = |id: ValueId| self.schedule.value(id);
        let is_small = |id: ValueId| matches!(value(id), Value::Constant(number) if number.to_f64() <= 1.0);
        self.finite[id.0]
            || match value(id) {
                Value::Call(Function::Sin | Function::Cos, angle) => self.finite[self.itself(angle[0].value).0],
                // `atan2` of NaN is NaN, but of infinities finite: its arguments must be checked results.
                Value::Call(Function::Atan2, parts) => parts.iter().all(|part| self.checked[self.itself(part.value).0]),
                // Half a chord, for instance.
                Value::Product(factors) => {
                    matches!(*factors.as_slice(), [number, other] if is_small(number) && self.finite[self.itself(other).0])
                }
                _ => false,
            }
    }

    /// Resolves symbols to the values that they name.
    fn itself(&self, id: ValueId) -> ValueId {
        let mut id = id;
        // Bounded, since names may be circular if the budget was exceeded.
        for _ in 0..=self.named.len() {
            let Value::Symbol(symbol) = self.schedule.value(id) else { break };
            let Some(value) = self.named.get(symbol) else { break };
            id = *value;
        }
        id
    }
}
