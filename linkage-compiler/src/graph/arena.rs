//! The arena of the nodes; equal nodes are interned, and constants are evaluated.

use std::collections::BTreeSet;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::node::{Condition, Fault, Node, NodeId, SymbolId, node_value};
use super::{Function, Number};
use crate::budget::Budget;

/// An arena of expressions.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    /// The nodes in the order of creation, shared with the keys of `ids`.
    pub(super) nodes: Vec<Rc<Node>>,
    ids: FxHashMap<Rc<Node>, NodeId>,
    /// The value of each node without symbols.
    pub(super) values: Vec<Option<f64>>,
    /// True for each node that is undefined for some values of its symbols.
    may_be_undefined: Vec<bool>,
    symbols: Vec<String>,
    /// The names of the value and the derivatives of each user function.
    pub(super) externals: Vec<Vec<String>>,
    pub(super) fault: Option<Fault>,
    /// The faults of nodes, which recur with them: a node made in a failed attempt may be wanted again.
    faults: FxHashMap<NodeId, Fault>,
    pub(super) conditions: BTreeSet<Condition>,
    /// The remaining work; copies of a graph share it.
    pub(super) budget: Budget,
}

/// The budget steps of an allocated node. Allocation counts as more steps than a visit, so that the budget bounds
/// memory: a node takes about 150 bytes and 32 for each part, a symbol about 50. With half of these counts an
/// invocation that exceeds the budget could take twice the memory.
const STEPS_OF_A_NODE: usize = 64;
const STEPS_OF_A_PART: usize = 4;
const STEPS_OF_A_SYMBOL: usize = 16;

impl Graph {
    /// An empty graph with a budget.
    #[must_use]
    pub fn within(budget: &Budget) -> Self {
        Self { budget: budget.clone(), ..Self::default() }
    }

    /// A copy that has a budget of its own.
    #[must_use]
    pub fn copy_within(&self, budget: &Budget) -> Self {
        Self { budget: budget.clone(), ..self.clone() }
    }

    /// The remaining work. Once it is spent, no nodes are made, and an arbitrary node is returned instead.
    #[must_use]
    pub fn budget(&self) -> &Budget {
        &self.budget
    }

    /// Spends steps; returns an arbitrary node if the budget is exceeded.
    pub(super) fn unaffordable(&self, steps: usize) -> Option<NodeId> {
        (self.budget.spend(steps).is_err() && !self.nodes.is_empty()).then_some(NodeId(0))
    }

    /// Makes a new symbol; symbols with equal names are different.
    pub fn symbol(&mut self, name: impl Into<String>) -> SymbolId {
        self.budget.count(STEPS_OF_A_SYMBOL);
        self.symbols.push(name.into());
        SymbolId(self.symbols.len() - 1)
    }

    #[must_use]
    pub fn symbol_name(&self, symbol: SymbolId) -> &str {
        &self.symbols[symbol.0]
    }

    #[must_use]
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The number of distinct expressions.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The value of an expression without symbols.
    #[must_use]
    pub fn constant_value(&self, id: NodeId) -> Option<f64> {
        self.values[id.index()]
    }

    /// The exact value of a node that is a plain constant.
    #[must_use]
    pub fn as_number(&self, id: NodeId) -> Option<Number> {
        match self.node(id) {
            Node::Constant(value) => Some(*value),
            _ => None,
        }
    }

    #[must_use]
    pub fn as_symbol(&self, id: NodeId) -> Option<SymbolId> {
        match self.node(id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    #[must_use]
    pub fn is_zero(&self, id: NodeId) -> bool {
        self.as_number(id).is_some_and(Number::is_zero)
    }

    /// The first fault since the last call, if there was one.
    pub fn take_fault(&mut self) -> Option<Fault> {
        self.fault.take()
    }

    /// The result of `make` with the conditions that it assumes; `None` if it causes a fault.
    pub fn attempt<V>(&mut self, make: impl FnOnce(&mut Self) -> Option<V>) -> Option<(V, BTreeSet<Condition>)> {
        let (fault, conditions) = (self.fault.take(), self.take_conditions());
        let made = make(self);
        let failed = std::mem::replace(&mut self.fault, fault).is_some();
        let conditions = std::mem::replace(&mut self.conditions, conditions);
        made.filter(|_| !failed).map(|made| (made, conditions))
    }

    /// The conditions assumed since the last call.
    pub fn take_conditions(&mut self) -> BTreeSet<Condition> {
        std::mem::take(&mut self.conditions)
    }

    /// True if an expression is undefined for some values of its symbols.
    #[must_use]
    pub fn may_be_undefined(&self, id: NodeId) -> bool {
        self.may_be_undefined[id.index()]
    }

    /// Records that conditions are assumed.
    pub fn assume(&mut self, conditions: BTreeSet<Condition>) {
        self.conditions.extend(conditions);
    }

    /// Records that a term is dropped.
    pub(super) fn drop_term(&mut self, term: NodeId) {
        if self.may_be_undefined(term) {
            self.conditions.insert(Condition::Defined(term));
        }
    }

    fn has_gaps(&self, node: &Node) -> bool {
        match node {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => false,
            Node::Sum { terms, .. } => terms.iter().any(|(_, term)| self.may_be_undefined(*term)),
            Node::Product { factors, .. } => factors.iter().any(|&(base, exponent)| {
                self.may_be_undefined(base) || (exponent < 0 && self.values[base.index()].is_none())
            }),
            Node::Call(function, arguments) => {
                super::operation(*function).may_be_undefined()
                    || arguments.iter().any(|&argument| self.may_be_undefined(argument))
            }
            // A user function, such as a table, may have a limited domain.
            Node::External(..) => true,
        }
    }

    pub(super) fn intern(&mut self, node: Node) -> NodeId {
        if let Some(&id) = self.ids.get(&node) {
            self.fault = self.fault.or_else(|| self.faults.get(&id).copied());
            return id;
        }
        if let Some(any) = self.unaffordable(STEPS_OF_A_NODE + STEPS_OF_A_PART * node.parts()) {
            return any;
        }
        let value = node_value(&node, |_| None, |_, _| None, |id| self.values[id.index()]);
        let id = NodeId(self.nodes.len());
        if value.is_some_and(|value| !value.is_finite()) || self.is_out_of_range(&node) {
            let fault = Fault::of(&node);
            self.faults.insert(id, fault);
            self.fault.get_or_insert(fault);
        }
        self.values.push(value);
        // A node with a value has no symbols.
        let may_be_undefined = value.is_none() && self.has_gaps(&node);
        self.may_be_undefined.push(may_be_undefined);
        let node = Rc::new(node);
        self.nodes.push(Rc::clone(&node));
        self.ids.insert(node, id);
        id
    }

    /// True if a coefficient times the constant factors of its term is not a normal number.
    fn is_out_of_range(&self, node: &Node) -> bool {
        let normal = |value: f64| value.is_normal() || value == 0.0;
        match node {
            Node::Sum { constant, terms } => {
                let factor = |&(coefficient, term): &(Number, NodeId)| match self.node(term) {
                    Node::Product { factors, .. } => coefficient.to_f64() * self.constant_factor(factors),
                    _ => coefficient.to_f64(),
                };
                !normal(constant.to_f64()) || !terms.iter().map(factor).all(f64::is_normal)
            }
            Node::Product { coefficient, factors } => {
                !(coefficient.to_f64() * self.constant_factor(factors)).is_normal()
            }
            Node::Constant(value) => !normal(value.to_f64()),
            _ => false,
        }
    }

    /// The product of the factors that are constants.
    fn constant_factor(&self, factors: &[(NodeId, i32)]) -> f64 {
        factors.iter().filter_map(|&(base, exponent)| Some(self.constant_value(base)?.powi(exponent))).product()
    }

    pub fn number(&mut self, value: Number) -> NodeId {
        self.intern(Node::Constant(value))
    }

    pub fn zero(&mut self) -> NodeId {
        self.number(Number::ZERO)
    }

    pub fn one(&mut self) -> NodeId {
        self.number(Number::ONE)
    }

    pub fn pi(&mut self) -> NodeId {
        self.intern(Node::Pi)
    }

    pub fn variable(&mut self, symbol: SymbolId) -> NodeId {
        self.intern(Node::Symbol(symbol))
    }

    /// `function(arguments)`; signs and quarter turns are moved out of sines and cosines, and functions of numbers with
    /// exact values are these.
    pub fn call(&mut self, function: Function, arguments: &[NodeId]) -> NodeId {
        if let Some(exact) = self.exact(function, arguments) {
            return exact;
        }
        match (function, arguments) {
            (Function::Sin | Function::Cos, &[angle]) => self.circular(function, angle),
            (Function::Abs, &[x]) => match self.as_number(x) {
                Some(number) => self.number(number.absolute()),
                None => self.intern(Node::Call(function, vec![x])),
            },
            // hypot(x, 0) = |x|; of two zeros it is left to the arithmetic of the emitted code, since quotients by it are.
            (Function::Hypot, &[x, y]) if self.is_zero(x) != self.is_zero(y) => {
                self.call(Function::Abs, &[if self.is_zero(x) { y } else { x }])
            }
            (Function::IfNonzero, &[_, value, limit]) if value == limit => value,
            (Function::IfNonzero, &[a, value, limit]) if self.constant_value(a).is_some() => {
                if self.is_zero(a) {
                    limit
                } else {
                    value
                }
            }
            _ => self.intern(Node::Call(function, arguments.to_vec())),
        }
    }

    /// True of a length or another magnitude: its derivatives are 0 / 0 where it is zero.
    #[must_use]
    pub fn is_length(&self, id: NodeId) -> bool {
        matches!(self.node(id), Node::Call(Function::Hypot | Function::Abs | Function::Sqrt, _))
    }

    /// True if the first coefficient is negative: then the sign is moved out of odd functions.
    #[must_use]
    pub fn leads_negative(&self, id: NodeId) -> bool {
        match self.node(id) {
            Node::Constant(value) => value.is_negative(),
            Node::Product { coefficient, .. } => coefficient.is_negative(),
            Node::Sum { terms, .. } => terms.first().is_some_and(|(factor, _)| factor.is_negative()),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(graph: &mut Graph) -> (NodeId, NodeId) {
        let (a, b) = (graph.symbol("a"), graph.symbol("b"));
        (graph.variable(a), graph.variable(b))
    }

    #[test]
    fn equal_expressions_are_one_node() {
        let mut g = Graph::default();
        let (a, b) = symbols(&mut g);
        let left = g.subtract(a, b);
        let right = g.subtract(b, a);
        let right = g.negate(right);
        assert_eq!(left, right);
        let twice = g.add(a, a);
        assert_eq!(twice, g.scale(Number::integer(2), a));
        let square = g.multiply(a, a);
        assert_eq!(square, g.power(a, 2));
        let one = g.divide(twice, twice);
        assert_eq!(one, g.one());
    }

    #[test]
    fn quarter_turns_and_signs_leave_the_circular_functions() {
        let mut g = Graph::default();
        let (a, _) = symbols(&mut g);
        let pi = g.pi();
        for sixths in -24..=24 {
            let constant = g.scale(Number::ratio(sixths, 6), pi);
            for shifted in [constant, g.add(a, constant), g.subtract(constant, a)] {
                for function in [Function::Sin, Function::Cos] {
                    let node = g.call(function, &[shifted]);
                    let bind = |_| 0.7;
                    let angle = g.evaluate(&[shifted], bind)[0];
                    let expected = (super::super::operation(function).value)(&[angle]);
                    let found = g.evaluate(&[node], bind)[0];
                    assert!((found - expected).abs() < 1e-14, "{function:?} {}", g.text(shifted));
                    if sixths % 3 == 0 {
                        assert!(!g.text(node).contains("pi"), "{}", g.text(node));
                    }
                }
            }
        }
    }

    /// The magnitudes of two parts that are zero add up to zero, not to a constant out of range.
    #[test]
    fn magnitudes_of_numbers_are_numbers() {
        let mut g = Graph::default();
        let parts = [Number::integer(0), Number::integer(0), Number::ratio(-3, 2)].map(|number| {
            let part = g.number(number);
            (Number::ONE, g.call(Function::Abs, &[part]))
        });
        let sum = g.sum(&parts);
        assert_eq!(g.as_number(sum), Some(Number::ratio(3, 2)));
        assert_eq!(g.take_fault(), None);
    }

    #[test]
    fn zero_divisors_are_faults() {
        let mut g = Graph::default();
        let (a, _) = symbols(&mut g);
        let zero = g.zero();
        g.divide(a, zero);
        assert_eq!(g.take_fault(), Some(Fault::DivisionByZero));
        assert_eq!(g.take_fault(), None);
    }

    /// An expression of a failed attempt has its fault wherever it is made again.
    #[test]
    fn faults_recur() {
        let mut g = Graph::default();
        let (a, _) = symbols(&mut g);
        let huge = g.number(Number::parse("1e200").unwrap());
        let squared = |g: &mut Graph| {
            let product = g.multiply(huge, a);
            g.power(product, 2)
        };
        assert!(g.attempt(|g| Some(squared(g))).is_none());
        assert_eq!(g.take_fault(), None);
        squared(&mut g);
        assert_eq!(g.take_fault(), Some(Fault::OutOfRange));
    }
}
