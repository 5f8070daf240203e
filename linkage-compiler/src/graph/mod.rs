//! The expression graph: hash-consed nodes with exact constants and n-ary sums and products.
//!
//! Equal expressions are one node, so derivatives share what they have in common and no
//! formula swells. Children always precede their parents, hence every traversal is a loop
//! over ascending ids: nothing here recurses, whatever the depth of an expression.

mod circular;
mod differentiate;
mod external;
mod function;
mod interpret;
mod number;
mod print;
mod replace;
mod sweep;

use std::collections::BTreeSet;

pub use external::{External, ExternalId};
pub use function::{Function, OPERATIONS, Operation};
pub use number::Number;
pub use print::{Name, Printer, Texts};

use crate::places::{Hash, Places};

/// An expression of a [`Graph`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

/// A name of a [`Graph`]: parameter, coordinate, rate, or a quantity solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SymbolId(u32);

/// What an expression is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Node {
    Constant(Number),
    Pi,
    Symbol(SymbolId),
    /// constant + sum of coefficient * term; terms ascend, no coefficient is zero, no term is
    /// itself a constant, a product with a coefficient or a sum, but for long ones.
    Sum {
        constant: Number,
        terms: Vec<(Number, NodeId)>,
    },
    /// coefficient * product of base^exponent; bases ascend, no exponent is zero, no base is
    /// itself a product, but for parts of long ones.
    Product {
        coefficient: Number,
        factors: Vec<(NodeId, i32)>,
    },
    Call(Function, Vec<NodeId>),
    /// A function of the user's, or a derivative of it.
    External(External, Vec<NodeId>),
}

/// Why an expression has no value at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    DivisionByZero,
    NotFinite,
    ExponentOverflow,
}

/// A sum of more terms than this stays one term of a sum that it is put into: otherwise a chain in
/// which each member adds to the one before would grow with the square of its length.
const LONGEST_MERGED: usize = 64;

/// A product has no more factors than this; longer ones are products of products. The derivative of a
/// product has as many terms as factors, each as long as the product.
const LONGEST_PRODUCT: usize = 16;

/// What was taken for granted when something was cancelled: where it fails, the expression as
/// written has no value although the shorter one may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Condition {
    /// x / x = 1
    NonZero(NodeId),
    /// f - f = 0, 0 f = 0
    Defined(NodeId),
}

/// An arena of expressions.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    ids: Places,
    /// The value of each node that holds no symbol.
    values: Vec<Option<f64>>,
    /// Whether a node has no value for some values of its symbols.
    partial: Vec<bool>,
    symbols: Vec<String>,
    /// The names of the value and the derivatives of each function of the user's.
    externals: Vec<Vec<String>>,
    fault: Option<Fault>,
    conditions: BTreeSet<Condition>,
}

impl SymbolId {
    /// No symbol at all.
    pub const NONE: Self = Self(u32::MAX);

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

impl NodeId {
    fn new(index: usize) -> Self {
        Self(u32::try_from(index).unwrap_or(u32::MAX))
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

impl Node {
    fn hash(&self) -> Hash {
        match self {
            Self::Constant(number) => number.hashed(Hash::of(0)),
            Self::Pi => Hash::of(1),
            Self::Symbol(symbol) => Hash::of(2).with(u64::from(symbol.0)),
            Self::Sum { constant, terms } => {
                let mut hash = constant.hashed(Hash::of(3));
                for (coefficient, term) in terms {
                    hash = coefficient.hashed(hash).with(u64::from(term.0));
                }
                hash
            }
            Self::Product { coefficient, factors } => {
                let mut hash = coefficient.hashed(Hash::of(4));
                for (base, exponent) in factors {
                    hash = hash.with(u64::from(base.0) << 32 | u64::from(exponent.cast_unsigned()));
                }
                hash
            }
            Self::Call(function, arguments) => {
                let mut hash = Hash::of(5).with(*function as u64);
                for argument in arguments {
                    hash = hash.with(u64::from(argument.0));
                }
                hash
            }
            Self::External(external, arguments) => {
                let mut hash = Hash::of(6).with(external.function.index() as u64);
                for &times in &external.by {
                    hash = hash.with(u64::from(times));
                }
                for argument in arguments {
                    hash = hash.with(u64::from(argument.0));
                }
                hash
            }
        }
    }
}

impl Graph {
    /// A new name; two symbols of one name are two symbols.
    pub fn symbol(&mut self, name: impl Into<String>) -> SymbolId {
        self.symbols.push(name.into());
        SymbolId(u32::try_from(self.symbols.len() - 1).unwrap_or(u32::MAX))
    }

    #[must_use]
    pub fn symbol_name(&self, symbol: SymbolId) -> &str {
        &self.symbols[symbol.0 as usize]
    }

    #[must_use]
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes.as_slice()[id.index()]
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
        self.values.as_slice()[id.index()]
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

    /// What went wrong since the last call, if anything did.
    pub fn take_fault(&mut self) -> Option<Fault> {
        self.fault.take()
    }

    /// What has been taken for granted since the last call.
    pub fn take_conditions(&mut self) -> BTreeSet<Condition> {
        std::mem::take(&mut self.conditions)
    }

    /// Whether an expression has no value for some values of its symbols.
    #[must_use]
    pub fn is_partial(&self, id: NodeId) -> bool {
        self.partial[id.index()]
    }

    /// Records what is taken for granted.
    pub fn assume(&mut self, conditions: BTreeSet<Condition>) {
        self.conditions.extend(conditions);
    }

    /// Records that a term is dropped.
    fn drop_term(&mut self, term: NodeId) {
        if self.is_partial(term) {
            self.conditions.insert(Condition::Defined(term));
        }
    }

    fn has_partial_value(&self, node: &Node) -> bool {
        match node {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => false,
            Node::Sum { terms, .. } => terms.iter().any(|(_, term)| self.is_partial(*term)),
            Node::Product { factors, .. } => factors.iter().any(|&(base, exponent)| {
                self.is_partial(base) || (exponent < 0 && self.values[base.index()].is_none())
            }),
            Node::Call(function, arguments) => {
                function.operation().partial || arguments.iter().any(|&argument| self.is_partial(argument))
            }
            // A table ends somewhere.
            Node::External(..) => true,
        }
    }

    fn intern(&mut self, node: Node) -> NodeId {
        let hash = node.hash();
        if let Some(place) = self.ids.find(hash, |place| self.nodes[place] == node) {
            return NodeId::new(place);
        }
        let value = interpret::node_value(&node, |_| None, |_, _| None, |id| self.values[id.index()]);
        if value.is_some_and(|value| !value.is_finite()) {
            self.fault.get_or_insert(Fault::NotFinite);
        }
        let id = NodeId::new(self.nodes.len());
        self.values.push(value);
        // What has a value has no symbols that could take it away.
        let partial = value.is_none() && self.has_partial_value(&node);
        self.partial.push(partial);
        self.ids.insert(hash, self.nodes.len());
        self.nodes.push(node);
        id
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

    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(&[(Number::ONE, a), (Number::ONE, b)])
    }

    pub fn subtract(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.sum(&[(Number::ONE, a), (Number::MINUS_ONE, b)])
    }

    pub fn negate(&mut self, a: NodeId) -> NodeId {
        self.scale(Number::MINUS_ONE, a)
    }

    pub fn scale(&mut self, factor: Number, a: NodeId) -> NodeId {
        if factor.is_one() {
            return a;
        }
        let factor = self.number(factor);
        self.multiply(factor, a)
    }

    pub fn multiply(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, 1), (b, 1)])
    }

    pub fn divide(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.product(&[(a, 1), (b, -1)])
    }

    pub fn power(&mut self, base: NodeId, exponent: i32) -> NodeId {
        self.product(&[(base, exponent)])
    }

    /// The sum of coefficient * item, like terms collected.
    pub fn sum(&mut self, items: &[(Number, NodeId)]) -> NodeId {
        let mut constant = Number::ZERO;
        let mut terms: Vec<(NodeId, Number)> = Vec::with_capacity(items.len() + 2);
        let mut collect = |coefficient: Number, term: NodeId| {
            let entry = entry(&mut terms, term, Number::ZERO);
            *entry = entry.plus(coefficient);
        };
        for &(coefficient, item) in items {
            match &self.nodes[item.index()] {
                Node::Constant(value) => constant = constant.plus(coefficient.multiply(*value)),
                Node::Sum { constant: inner, terms } if terms.len() <= LONGEST_MERGED => {
                    constant = constant.plus(coefficient.multiply(*inner));
                    for (factor, term) in terms {
                        collect(coefficient.multiply(*factor), *term);
                    }
                }
                Node::Product { coefficient: inner, factors } if !inner.is_one() => {
                    let total = coefficient.multiply(*inner);
                    let monic = self.monic(factors.clone());
                    // 2 * (a + b) is a product with a coefficient whose monic part is a sum.
                    match &self.nodes[monic.index()] {
                        Node::Sum { constant: k, terms } if terms.len() <= LONGEST_MERGED => {
                            constant = constant.plus(total.multiply(*k));
                            for (factor, term) in terms {
                                collect(total.multiply(*factor), *term);
                            }
                        }
                        _ => collect(total, monic),
                    }
                }
                _ => collect(coefficient, item),
            }
        }
        for (term, coefficient) in &terms {
            if coefficient.is_zero() {
                self.drop_term(*term);
            }
        }
        terms.retain(|(_, coefficient)| !coefficient.is_zero());
        let terms: Vec<_> = terms.into_iter().map(|(term, coefficient)| (coefficient, term)).collect();
        match terms.as_slice() {
            [] => self.number(constant),
            &[(coefficient, term)] if constant.is_zero() => self.scale(coefficient, term),
            _ => self.intern(Node::Sum { constant, terms }),
        }
    }

    /// Products of products, none longer than [`LONGEST_PRODUCT`]; the same factors give the same tree.
    fn grouped(&mut self, mut factors: Vec<(NodeId, i32)>) -> Vec<(NodeId, i32)> {
        while factors.len() > LONGEST_PRODUCT {
            let mut groups: Vec<(NodeId, i32)> =
                factors.chunks(LONGEST_PRODUCT).map(|group| (self.monic(group.to_vec()), 1)).collect();
            groups.sort_unstable();
            factors = groups;
        }
        factors
    }

    fn monic(&mut self, factors: Vec<(NodeId, i32)>) -> NodeId {
        match factors.as_slice() {
            [] => self.one(),
            &[(base, 1)] => base,
            _ => self.intern(Node::Product { coefficient: Number::ONE, factors }),
        }
    }

    /// The product of item^exponent, equal bases collected.
    pub fn product(&mut self, items: &[(NodeId, i32)]) -> NodeId {
        let mut coefficient = Number::ONE;
        let mut factors: Vec<(NodeId, i32)> = Vec::with_capacity(items.len() + 2);
        let mut overflow = false;
        let mut divisors: Vec<NodeId> = Vec::new();
        let mut collect = |base: NodeId, exponent: Option<i32>| {
            let entry = entry(&mut factors, base, 0);
            match exponent.and_then(|exponent| entry.checked_add(exponent)) {
                Some(total) => *entry = total,
                None => overflow = true,
            }
        };
        for &(item, exponent) in items {
            match &self.nodes[item.index()] {
                Node::Constant(value) => {
                    if value.is_zero() && exponent <= 0 {
                        self.fault.get_or_insert(Fault::DivisionByZero);
                    }
                    coefficient = coefficient.multiply(value.power(exponent));
                }
                Node::Product { coefficient: inner, factors } => {
                    coefficient = coefficient.multiply(inner.power(exponent));
                    for &(base, inner) in factors {
                        collect(base, inner.checked_mul(exponent));
                        // 1/(1/x) is x for an x other than zero.
                        if inner < 0 || exponent < 0 {
                            divisors.push(base);
                        }
                    }
                }
                _ => {
                    collect(item, Some(exponent));
                    if exponent < 0 {
                        divisors.push(item);
                    }
                }
            }
        }
        if overflow {
            self.fault.get_or_insert(Fault::ExponentOverflow);
        }
        for divisor in divisors {
            let cancelled = *entry(&mut factors, divisor, 0) >= 0 || coefficient.is_zero();
            if cancelled && self.values[divisor.index()].is_none() {
                self.conditions.insert(Condition::NonZero(divisor));
            }
        }
        for (base, exponent) in &factors {
            if *exponent == 0 || coefficient.is_zero() {
                self.drop_term(*base);
            }
        }
        factors.retain(|(_, exponent)| *exponent != 0);
        let factors = self.grouped(factors);
        if coefficient.is_zero() || factors.is_empty() {
            return self.number(coefficient);
        }
        if coefficient.is_one() {
            return self.monic(factors);
        }
        // A sign belongs inside a sum, so that -(a - b) and b - a are one node.
        if let (true, &[(base, 1)]) = (coefficient == Number::MINUS_ONE, factors.as_slice())
            && let Node::Sum { constant, terms } = self.node(base).clone()
        {
            let terms = terms.into_iter().map(|(factor, term)| (factor.negate(), term)).collect();
            return self.intern(Node::Sum { constant: constant.negate(), terms });
        }
        self.intern(Node::Product { coefficient, factors })
    }

    /// `function(arguments)`; sines and cosines take out signs and quarter turns.
    pub fn call(&mut self, function: Function, arguments: &[NodeId]) -> NodeId {
        match (function, arguments) {
            (Function::Sin | Function::Cos, &[angle]) => self.circular(function, angle),
            (Function::Sqrt, &[x]) => {
                let exact = self.as_number(x).and_then(square_root);
                match exact {
                    Some(root) => self.number(root),
                    None => self.intern(Node::Call(function, vec![x])),
                }
            }
            _ => self.intern(Node::Call(function, arguments.to_vec())),
        }
    }

    /// Whether the first coefficient as written is negative: the sign to take out of an odd function.
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

/// The value of a key in an ascending list, put there if it is not.
fn entry<V>(list: &mut Vec<(NodeId, V)>, key: NodeId, empty: V) -> &mut V {
    // Most keys come in ascending order.
    if list.last().is_none_or(|(last, _)| last.0 < key.0) {
        list.push((key, empty));
        let last = list.len() - 1;
        return &mut list[last].1;
    }
    let index = match list.binary_search_by_key(&key, |(key, _)| *key) {
        Ok(index) => index,
        Err(index) => {
            list.insert(index, (key, empty));
            index
        }
    };
    &mut list[index].1
}

/// The exact square root of a ratio of squares.
fn square_root(value: Number) -> Option<Number> {
    let root = |n: i64| u64::try_from(n).ok().map(u64::isqrt).filter(|r| r * r == n.unsigned_abs());
    match value {
        Number::Ratio(n, d) => Some(Number::ratio(i128::from(root(n)?), i128::from(root(d)?))),
        Number::Float(_) => None,
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
                    let expected = (function.operation().value)(&[angle]);
                    let found = g.evaluate(&[node], bind)[0];
                    assert!((found - expected).abs() < 1e-14, "{function:?} {}", g.text(shifted));
                    if sixths % 3 == 0 {
                        assert!(!g.text(node).contains("pi"), "{}", g.text(node));
                    }
                }
            }
        }
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
}
