//! Translation of nodes to values: signs are moved to sums and results, quotients with a common divisor share its
//! inverse, and powers become repeated squares.

use std::collections::{BTreeMap, BTreeSet};

use linkage_ir::ValueId;
use rustc_hash::{FxHashMap, FxHashSet};

use super::value::{Leaf, Signed, Value};
use crate::graph::{Function, Graph, Node, NodeId, Number};
use crate::program::Given;

/// Translates nodes to values.
pub(super) struct Builder<'a> {
    graph: &'a Graph,
    given: &'a Given,
    values: Vec<Value>,
    ids: FxHashMap<Value, ValueId>,
    /// The value of each node so far.
    of: FxHashMap<NodeId, Signed>,
}

impl<'a> Builder<'a> {
    /// Translates the roots; returns all values, and the value of each node.
    pub(super) fn translate_all(
        graph: &'a Graph,
        given: &'a Given,
        roots: &[NodeId],
    ) -> (Vec<Value>, FxHashMap<NodeId, Signed>) {
        let (values, ids, of) = (Vec::new(), FxHashMap::default(), FxHashMap::default());
        let mut builder = Self { graph, given, values, ids, of };
        let ordered = graph.sweep(roots, |_| false, |id| builder.is_leaf(id));
        let shared = builder.shared_divisors(&ordered);
        for id in ordered {
            let signed = builder.leaf(id).unwrap_or_else(|| builder.translate(id, &shared));
            builder.of.insert(id, signed);
        }
        (builder.values, builder.of)
    }

    fn is_leaf(&self, id: NodeId) -> bool {
        self.given.holds(self.graph, id) || self.given.constant(self.graph, id).is_some()
    }

    /// The value of a constant, a symbol or a given expression; `None` for other nodes.
    fn leaf(&mut self, id: NodeId) -> Option<Signed> {
        let value = match self.graph.node(id) {
            Node::Constant(number) => return Some(self.constant(*number)),
            Node::Symbol(symbol) => Value::Given(Leaf::Symbol(*symbol)),
            Node::Call(function @ (Function::Sin | Function::Cos), angle)
                if self.given.directions.contains(&angle[0]) =>
            {
                Value::Given(Leaf::Direction(*function, angle[0]))
            }
            _ => match self.given.values.get(&id) {
                Some(symbol) => Value::Given(Leaf::Symbol(*symbol)),
                None => return self.given.constant(self.graph, id).map(|value| self.constant(Number::Float(value))),
            },
        };
        Some(self.positive(value))
    }

    /// The divisors of more than one quotient, which are inverted once.
    fn shared_divisors(&self, nodes: &[NodeId]) -> BTreeSet<Vec<(NodeId, i32)>> {
        let mut count: BTreeMap<Vec<(NodeId, i32)>, usize> = BTreeMap::new();
        for &id in nodes {
            if let Node::Product { factors, .. } = self.graph.node(id)
                && factors.iter().any(|(_, exponent)| *exponent < 0)
            {
                *count.entry(divisor(factors)).or_default() += 1;
            }
        }
        count.into_iter().filter(|(_, uses)| *uses > 1).map(|(divisor, _)| divisor).collect()
    }

    fn intern(&mut self, value: Value) -> ValueId {
        *self.ids.entry(value).or_insert_with_key(|value| {
            self.values.push(value.clone());
            ValueId::new(self.values.len() - 1)
        })
    }

    fn positive(&mut self, value: Value) -> Signed {
        Signed { negative: false, value: self.intern(value) }
    }

    fn constant(&mut self, number: Number) -> Signed {
        Signed { negative: number.is_negative(), value: self.intern(Value::Constant(number.absolute())) }
    }

    fn translate(&mut self, id: NodeId, shared: &BTreeSet<Vec<(NodeId, i32)>>) -> Signed {
        match self.graph.node(id) {
            Node::Sum { constant, terms } => {
                let mut signed = Vec::new();
                for &(coefficient, term) in terms {
                    let term = self.of[&term];
                    let value = self.scaled(coefficient.absolute(), term.value);
                    signed.push(Signed { negative: term.negative != coefficient.is_negative(), value });
                }
                if !constant.is_zero() {
                    signed.push(self.constant(*constant));
                }
                self.sum(signed)
            }
            Node::Product { coefficient, factors } => self.product(*coefficient, factors, shared),
            Node::Call(function, arguments) => {
                let mut arguments: Vec<Signed> = arguments.iter().map(|argument| self.of[argument]).collect();
                if matches!(function, Function::Hypot | Function::Abs) {
                    // hypot and abs ignore signs.
                    arguments.iter_mut().for_each(|argument| argument.negative = false);
                }
                self.positive(Value::Call(*function, arguments))
            }
            Node::External(external, arguments) => {
                let arguments = arguments.iter().map(|argument| self.of[argument]).collect();
                self.positive(Value::Given(Leaf::External(external.clone(), arguments)))
            }
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => self.constant(Number::ZERO),
        }
    }

    /// Interns a sum. Its sign is moved out, so that a - b and b - a are one value and at most half of the terms are
    /// subtracted.
    fn sum(&mut self, terms: Vec<Signed>) -> Signed {
        let mut terms = self.collected(terms);
        match terms.as_slice() {
            [] => return self.constant(Number::ZERO),
            &[only] => return only,
            _ => {}
        }
        let negatives = terms.iter().filter(|term| term.negative).count();
        let flip = 2 * negatives > terms.len() || (2 * negatives == terms.len() && terms[0].negative);
        for term in &mut terms {
            term.negative ^= flip;
        }
        Signed { negative: flip, value: self.intern(Value::Sum(terms)) }
    }

    /// Collects equal values in a sum, which may arise since signs are moved out.
    fn collected(&mut self, mut terms: Vec<Signed>) -> Vec<Signed> {
        // A collected term may equal another one: repeat.
        while has_twice(terms.iter().map(|term| term.value)) {
            let mut order = Vec::new();
            let mut counts: FxHashMap<ValueId, i64> = FxHashMap::default();
            for term in terms {
                let count = counts.entry(term.value).or_insert_with(|| {
                    order.push(term.value);
                    0
                });
                *count += if term.negative { -1 } else { 1 };
            }
            terms = Vec::new();
            for value in order {
                let count = counts[&value];
                if count != 0 {
                    let value = self.scaled(Number::integer(count.abs()), value);
                    terms.push(Signed { negative: count < 0, value });
                }
            }
        }
        terms
    }

    /// The product of two numbers, if it is finite, and exact where it must be.
    fn folded(&self, one: Number, other: Number) -> Option<Number> {
        let product = one.multiply(other);
        let is_exact = matches!(product, Number::Ratio(..));
        (product.is_finite() && (is_exact || !self.given.is_exact)).then_some(product)
    }

    /// Collects equal factors of a product into squares, and all numbers into one.
    fn gathered(&mut self, mut constant: Number, mut factors: Vec<ValueId>) -> (Number, Vec<ValueId>) {
        factors.retain(|factor| {
            let Value::Constant(number) = self.values[factor.index()] else { return true };
            let product = self.folded(constant, number);
            constant = product.unwrap_or(constant);
            product.is_none()
        });
        while has_twice(factors.iter().copied()) {
            factors.sort_unstable();
            let mut once = Vec::new();
            for factor in factors {
                match once.pop_if(|last| *last == factor) {
                    // The square differs from a third equal factor.
                    Some(twice) => once.extend([self.intern(Value::Square(twice))]),
                    None => once.push(factor),
                }
            }
            factors = once;
        }
        (constant, factors)
    }

    fn product(
        &mut self,
        coefficient: Number,
        factors: &[(NodeId, i32)],
        shared: &BTreeSet<Vec<(NodeId, i32)>>,
    ) -> Signed {
        let mut constant = coefficient;
        let mut negative = false;
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for &(base, exponent) in factors {
            if let Some(value) = self.given.constant(self.graph, base) {
                constant = constant.multiply(Number::Float(value.powi(exponent)));
                continue;
            }
            let signed = self.of[&base];
            negative ^= signed.negative && exponent % 2 != 0;
            let factors = if exponent > 0 { &mut above } else { &mut below };
            self.power(signed.value, exponent.unsigned_abs(), factors);
        }
        negative ^= constant.is_negative();
        let constant = constant.absolute();
        if below.is_empty() {
            let value = self.multiply(constant, above);
            return Signed { negative, value };
        }
        let divisor_value = self.multiply(Number::ONE, below);
        let value = if shared.contains(&divisor(factors)) {
            let one = self.constant(Number::ONE).value;
            let inverse = self.intern(Value::Quotient(one, divisor_value));
            above.push(inverse);
            self.multiply(constant, above)
        } else {
            let above = self.multiply(constant, above);
            self.intern(Value::Quotient(above, divisor_value))
        };
        Signed { negative, value }
    }

    /// Adds x^n as factors by repeated squaring: x^5 = x (x^2)^2.
    fn power(&mut self, base: ValueId, exponent: u32, factors: &mut Vec<ValueId>) {
        let (mut square, mut rest) = (base, exponent);
        loop {
            if rest % 2 == 1 {
                factors.push(square);
            }
            rest /= 2;
            if rest == 0 {
                return;
            }
            square = self.intern(Value::Square(square));
        }
    }

    fn multiply(&mut self, constant: Number, factors: Vec<ValueId>) -> ValueId {
        let (constant, mut factors) = self.gathered(constant, factors);
        if constant.is_zero() {
            return self.constant(Number::ZERO).value;
        }
        if !constant.is_one() || factors.is_empty() {
            factors.insert(0, self.constant(constant).value);
        }
        match factors.as_slice() {
            &[only] => only,
            _ => {
                factors.sort_unstable();
                self.intern(Value::Product(factors))
            }
        }
    }

    fn scaled(&mut self, factor: Number, value: ValueId) -> ValueId {
        if factor.is_one() {
            return value;
        }
        match self.values[value.index()].clone() {
            Value::Constant(number) => match self.folded(number, factor) {
                Some(product) => self.constant(product).value,
                None => self.multiply(factor, vec![value]),
            },
            Value::Product(factors) => self.multiply(factor, factors),
            Value::Quotient(above, below) => {
                let above = self.scaled(factor, above);
                self.intern(Value::Quotient(above, below))
            }
            _ => self.multiply(factor, vec![value]),
        }
    }
}

fn divisor(factors: &[(NodeId, i32)]) -> Vec<(NodeId, i32)> {
    factors.iter().filter(|(_, exponent)| *exponent < 0).copied().collect()
}

/// True if a list contains a value twice.
fn has_twice(mut list: impl Iterator<Item = ValueId>) -> bool {
    let mut met = FxHashSet::default();
    !list.all(|value| met.insert(value))
}
