//! Operation counts of functions that call others.
//!
//! Layers are inlined, so that an optimiser computes once what a function and its layers have in common: the count of the
//! function has it once as well. The operations of other functions that it calls are added.

use std::collections::{BTreeMap, BTreeSet};

use linkage_ir::ValueId;
use linkage_ir::code::Callee;
use rustc_hash::FxHashMap;

use super::schedule::{Line, Schedule};
use super::value::{Leaf, Signed, Value, with_operands};
use crate::graph::Function;
use crate::program::{Intrinsic, Operations};

/// The operations of the functions lowered so far.
#[derive(Debug, Clone, Default)]
pub(super) struct Counts {
    of: BTreeMap<Callee, Count>,
    /// The numbers of operations whose operands are numbers as well, the same in all functions.
    numbers: FxHashMap<Value, ValueId>,
}

/// The operations of a function.
#[derive(Debug, Clone, Default)]
pub(super) struct Count {
    /// By number.
    numbered: BTreeMap<ValueId, Operations>,
    others: Operations,
    is_layer: bool,
}

impl Count {
    pub(super) fn total(&self) -> Operations {
        self.numbered.values().fold(self.others, |total, operations| total.plus(*operations))
    }
}

impl Counts {
    /// The count of a function: that of its kernel, of the functions that it calls, and others.
    pub(super) fn of_body(
        &mut self,
        kernel: Option<&Schedule>,
        is_layer: bool,
        calls: &[Callee],
        others: Operations,
    ) -> Count {
        let mut count = Count { others, is_layer, ..Count::default() };
        let mut layers = BTreeSet::new();
        for call in calls {
            let Some(called) = self.of.get(call) else { continue };
            // A second call has other arguments.
            if called.is_layer && layers.insert(call) {
                count.numbered.extend(&called.numbered);
                count.others += called.others;
            } else {
                count.others += called.total();
            }
        }
        match kernel {
            Some(kernel) if is_layer || !layers.is_empty() => self.number_all(kernel, &mut count),
            Some(kernel) => count.others += kernel.operations(),
            None => {}
        }
        count
    }

    pub(super) fn insert(&mut self, function: Callee, count: Count) {
        self.of.insert(function, count);
    }

    /// Those of the driver, as the functions of a scene call them.
    #[must_use]
    pub(super) fn of_driver(&self) -> Self {
        let of = self.of.iter().filter(|(callee, _)| matches!(callee, Callee::OfDriver(_)));
        Self { of: of.map(|(callee, count)| (*callee, count.clone())).collect(), numbers: self.numbers.clone() }
    }

    /// Adds the operations of a kernel.
    fn number_all(&mut self, kernel: &Schedule, count: &mut Count) {
        let mut numbers: FxHashMap<ValueId, ValueId> = FxHashMap::default();
        let mut stack = kernel.used().to_vec();
        while let Some(&id) = stack.last() {
            let (value, depth) = (kernel.value(id), stack.len());
            if !numbers.contains_key(&id) {
                value.each_part(|part| stack.extend((!numbers.contains_key(&part)).then_some(part)));
            }
            if stack.len() == depth {
                stack.pop();
                let number = self.number(value, &numbers, count);
                numbers.insert(id, number);
            }
        }
        let is_external = |id: &&ValueId| matches!(kernel.value(**id), Value::Given(Leaf::External(..)));
        count.others.functions += kernel.used().iter().filter(is_external).count();
        for line in &kernel.lines {
            match line {
                Line::Chord { .. } => count.others += Intrinsic::Chord.row().cost,
                // A user function and its derivatives are one function; each function calls it anew.
                Line::External { values, .. } => {
                    count.others.functions -= values.iter().flatten().count().saturating_sub(1);
                }
                _ => {}
            }
        }
    }

    /// The number of a value; what it takes is added to the count. Sums and products are computed from left to right.
    fn number(&mut self, value: &Value, numbers: &FxHashMap<ValueId, ValueId>, count: &mut Count) -> ValueId {
        let addition = Operations { additions: 1, ..Operations::default() };
        let multiplication = Operations { multiplications: 1, ..Operations::default() };
        let division = Operations { divisions: 1, ..Operations::default() };
        let call = Operations { functions: 1, ..Operations::default() };
        let none = Operations::default();
        let value = with_operands(value.clone(), &mut |id| numbers[&id]);
        match value {
            Value::Sum(terms) => {
                let sum = terms.into_iter().reduce(|left, right| {
                    let mut terms = vec![left, right];
                    terms.sort_unstable_by_key(|term| (term.negative, term.value));
                    Signed::positive(self.numbered(Value::Sum(terms), addition, count))
                });
                sum.map_or(ValueId::new(0), |sum| sum.value)
            }
            Value::Product(factors) => self.product(factors, multiplication, count),
            Value::Square(base) => self.product(vec![base; 2], multiplication, count),
            Value::Quotient(..) => self.numbered(value, division, count),
            Value::Call(Function::Abs | Function::IfNonzero, _) => self.numbered(value, none, count),
            // Sine and cosine of an angle are one function.
            Value::Call(Function::Cos, angle) => {
                self.numbered(Value::Call(Function::Sin, angle.clone()), call, count);
                self.numbered(Value::Call(Function::Cos, angle), none, count)
            }
            Value::Call(..) => self.numbered(value, call, count),
            _ => self.numbered(value, none, count),
        }
    }

    fn product(&mut self, factors: Vec<ValueId>, cost: Operations, count: &mut Count) -> ValueId {
        let product = factors.into_iter().reduce(|left, right| {
            let mut factors = vec![left, right];
            factors.sort_unstable();
            self.numbered(Value::Product(factors), cost, count)
        });
        product.unwrap_or(ValueId::new(0))
    }

    fn numbered(&mut self, operation: Value, cost: Operations, count: &mut Count) -> ValueId {
        let next = ValueId::new(self.numbers.len());
        let number = *self.numbers.entry(operation).or_insert(next);
        if cost != Operations::default() {
            count.numbered.insert(number, cost);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::ids::FunctionId;
    use crate::lower::schedule;
    use crate::program::Given;

    /// a b cos x + a b sin x + a^2 c / d, and a layer with a b and sin x alone.
    #[test]
    fn what_a_layer_computes_counts_once() {
        let mut graph = Graph::default();
        let [a, b, c, d, x] = ["a", "b", "c", "d", "x"].map(|name| {
            let symbol = graph.symbol(name);
            graph.variable(symbol)
        });
        let ab = graph.multiply(a, b);
        let (sine, cosine) = (graph.call(Function::Sin, &[x]), graph.call(Function::Cos, &[x]));
        let (first, second) = (graph.multiply(ab, cosine), graph.multiply(ab, sine));
        let square = graph.multiply(a, a);
        let third = graph.multiply(square, c);
        let third = graph.divide(third, d);
        let sum = graph.add(first, second);
        let sum = graph.add(sum, third);
        let kernel = |results: &[_], is_layer| schedule(&graph, &[], results, &Given::default(), &[], is_layer);
        let whole = kernel(&[sum], false);
        let expected = Operations { multiplications: 5, additions: 2, divisions: 1, functions: 1 };
        let mut counts = Counts::default();
        // As written, and by numbers.
        let plain = counts.of_body(Some(&whole), false, &[], Operations::default());
        assert_eq!(plain.total(), expected);
        let mut numbered = Count::default();
        counts.number_all(&whole, &mut numbered);
        assert_eq!(numbered.total(), expected);

        let layer = counts.of_body(Some(&kernel(&[ab, sine], true)), true, &[], Operations::default());
        assert_eq!(layer.total(), Operations { multiplications: 1, functions: 1, ..Operations::default() });
        let callee = Callee::Own(FunctionId::new(0));
        counts.insert(callee, layer);
        let calls = [callee; 2];
        let once = counts.of_body(Some(&whole), false, &calls[..1], Operations::default());
        assert_eq!(once.total(), expected);
        // The second call has other arguments.
        let twice = counts.of_body(Some(&whole), false, &calls, Operations::default());
        let more = Operations { multiplications: 6, functions: 2, ..expected };
        assert_eq!(twice.total(), more);
    }
}
