//! The nodes of formulas, each once.

use rustc_hash::FxHashMap;

use super::name::Name;
use crate::graph::Function;

/// The number of a node in its table, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Number(u32);

/// A node, as the runtime prints it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Node {
    Name(String),
    Rate(Number),
    Acceleration(Number),
    Ratio(Number, Number),
    RatioDerivative(Number, [Number; 2]),
    Determinant(Number),
    Inverse(Number),
    Integer(u64),
    /// A number by its bits.
    Decimal(u64),
    Pi,
    Ellipsis,
    /// Terms, each with true if it is subtracted.
    Sum(Vec<(bool, Number)>),
    Product(Vec<Number>),
    Quotient(Number, Number),
    Power(Number, u32),
    Call(Function, Vec<Number>),
    /// A user function and the order of its derivative.
    External(String, usize, Vec<Number>),
    /// A product of two with a sign between them in every notation.
    Multiple(Number, Number),
    AtMost(Vec<Number>),
    NonZero(Number),
    Exists(Number),
}

/// A flat table of nodes, each of which refers to nodes before it.
#[derive(Debug, Clone, Default)]
pub struct Table {
    nodes: Vec<Node>,
    numbers: FxHashMap<Node, Number>,
    /// The length of each node in bytes with the names of the `linkage!` language: `-l3*sin(theta3 - theta4)` is 24.
    lengths: Vec<usize>,
}

/// The largest length of a formula that is read, in bytes and in nodes; the longest of the gallery has 2359 bytes.
#[cfg(feature = "serde")]
const LONGEST: usize = 1 << 14;

/// The largest number of nodes within nodes of a formula that is read; the deepest of the gallery has 13.
#[cfg(feature = "serde")]
const DEEPEST: usize = 256;

/// A value with numbers in it.
pub(super) trait Numbers {
    /// Visits each number once.
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number));
}

impl Number {
    /// The number itself.
    #[must_use]
    pub fn get(self) -> u32 {
        self.0
    }

    fn index(self) -> usize {
        self.0 as usize - 1
    }
}

impl Table {
    /// The nodes in the order of their numbers.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = &Node> {
        self.nodes.iter()
    }

    /// True if a node is this name.
    #[must_use]
    pub fn is_name(&self, number: Number, name: &str) -> bool {
        matches!(self.nodes.get((number.0 as usize).wrapping_sub(1)), Some(Node::Name(text)) if text == name)
    }

    /// The number of a node, which is added if it is new.
    pub fn add(&mut self, node: Node) -> Number {
        if let Some(number) = self.numbers.get(&node) {
            return *number;
        }
        let number = Number(u32::try_from(self.nodes.len() + 1).unwrap_or(u32::MAX));
        let length = self.length_of(&node);
        self.numbers.insert(node.clone(), number);
        self.nodes.push(node);
        self.lengths.push(length);
        number
    }

    /// The table of these nodes; none if one refers to a node that is not before it, or is too large to be written.
    #[cfg(feature = "serde")]
    pub(super) fn of(nodes: Vec<Node>) -> Option<Self> {
        let mut table = Self::default();
        // Of each node how deep it is, and how many nodes it has, with a power as that many factors.
        let mut sizes: Vec<[usize; 2]> = Vec::new();
        for mut node in nodes {
            let (mut is_sound, mut depth, mut count) = (true, 0, 1_usize);
            node.each(&mut |part| {
                let inside = (part.0 as usize).checked_sub(1).and_then(|index| sizes.get(index));
                is_sound &= inside.is_some();
                let [deep, many] = inside.copied().unwrap_or_default();
                (depth, count) = (depth.max(deep + 1), count.saturating_add(many));
            });
            count = match node {
                Node::Power(_, exponent) => {
                    count.saturating_mul(usize::try_from(exponent).unwrap_or(usize::MAX).max(1))
                }
                Node::External(_, order, _) => count.saturating_add(order),
                _ => count,
            };
            if !is_sound || depth > DEEPEST || count > LONGEST {
                return None;
            }
            let length = table.length_of(&node);
            if length > LONGEST {
                return None;
            }
            table.nodes.push(node);
            table.lengths.push(length);
            sizes.push([depth, count]);
        }
        Some(table)
    }

    pub(super) fn node(&self, number: Number) -> &Node {
        &self.nodes[number.index()]
    }

    pub(super) fn length(&self, number: Number) -> usize {
        self.lengths[number.index()]
    }

    /// A quantity.
    pub fn plain(&mut self, name: &str) -> Number {
        self.add(Node::Name(name.to_owned()))
    }

    /// A name, or a derivative of one.
    pub fn name(&mut self, name: Name<'_>) -> Number {
        match name {
            Name::Plain(name) => self.plain(name),
            Name::Rate(name) => {
                let name = self.plain(name);
                self.add(Node::Rate(name))
            }
            Name::Acceleration(name) => {
                let name = self.plain(name);
                self.add(Node::Acceleration(name))
            }
            Name::Ratio { of, by } => {
                let [of, by] = [of, by].map(|name| self.plain(name));
                self.add(Node::Ratio(of, by))
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                let [of, first, second] = [of, first, second].map(|name| self.plain(name));
                self.add(Node::RatioDerivative(of, [first, second]))
            }
            Name::Determinant(group) => {
                let matrix = self.plain(&matrix_name(group));
                self.add(Node::Determinant(matrix))
            }
            Name::Inverse(group) => {
                let matrix = self.plain(&matrix_name(group));
                self.add(Node::Inverse(matrix))
            }
        }
    }

    /// A number that is printed as a decimal.
    pub fn decimal(&mut self, value: f64) -> Number {
        self.add(Node::Decimal(value.to_bits()))
    }

    /// The terms; a single one that is not subtracted is the sum.
    pub(super) fn sum(&mut self, terms: Vec<(bool, Number)>) -> Number {
        match terms.as_slice() {
            [(false, only)] => *only,
            _ => self.add(Node::Sum(terms)),
        }
    }

    /// The factors; a single one is the product.
    pub(super) fn product(&mut self, factors: Vec<Number>) -> Number {
        match factors.as_slice() {
            [only] => *only,
            _ => self.add(Node::Product(factors)),
        }
    }

    /// The nodes that these numbers need, in the same order; the numbers change.
    pub(super) fn reduced(self, numbers: &mut impl Numbers) -> Self {
        let mut is_needed = vec![false; self.nodes.len()];
        numbers.each(&mut |number| is_needed[number.index()] = true);
        for (index, node) in self.nodes.iter().enumerate().rev() {
            if is_needed[index] {
                node.clone().each(&mut |part| is_needed[part.index()] = true);
            }
        }
        let mut count = 0;
        let indices: Vec<Number> = is_needed
            .iter()
            .map(|is_needed| {
                count += u32::from(*is_needed);
                Number(count)
            })
            .collect();
        let mut table = Self::default();
        let kept = self.nodes.into_iter().zip(self.lengths).zip(is_needed);
        for (mut node, length) in kept.filter_map(|(node, is_needed)| is_needed.then_some(node)) {
            node.each(&mut |part| *part = indices[part.index()]);
            table.nodes.push(node);
            table.lengths.push(length);
        }
        numbers.each(&mut |number| *number = indices[number.index()]);
        table
    }

    /// The length of a formula.
    fn length_of(&self, node: &Node) -> usize {
        let length = |number: &Number| self.length(*number);
        let list = |parts: &[Number], length: &dyn Fn(&Number) -> usize, between: &str| {
            parts.iter().map(length).sum::<usize>() + between.len() * parts.len().saturating_sub(1)
        };
        let arguments = |arguments: &[Number]| list(arguments, &length, ", ") + "()".len();
        let factor = |number: &Number| self.within_brackets(*number, |node| matches!(node, Node::Product(_)));
        match node {
            Node::Name(name) => name.len(),
            Node::Rate(of) => length(of) + "'".len(),
            Node::Acceleration(of) => length(of) + "''".len(),
            Node::Ratio(of, by) => "∂(, )".len() + length(of) + length(by),
            Node::RatioDerivative(of, by) => "∂(, )".len() + length(of) + list(by, &length, ", "),
            Node::Determinant(matrix) => "||".len() + length(matrix),
            Node::Inverse(matrix) => "^-1".len() + length(matrix),
            Node::Integer(value) => value.to_string().len(),
            Node::Decimal(bits) => format!("{:?}", f64::from_bits(*bits)).len(),
            Node::Pi => "pi".len(),
            Node::Ellipsis => "…".len(),
            Node::Sum(terms) => {
                // A fraction in a sum has no brackets.
                let term = |(_, number): &(bool, Number)| match self.node(*number) {
                    Node::Sum(_) => length(number) + "()".len(),
                    _ => length(number),
                };
                let leading_minus = terms.first().is_some_and(|(is_negative, _)| *is_negative);
                terms.iter().map(term).sum::<usize>()
                    + " + ".len() * terms.len().saturating_sub(1)
                    + usize::from(leading_minus)
            }
            Node::Product(factors) => list(factors, &factor, "*"),
            Node::Quotient(above, below) => {
                let side = |number: &Number| match self.node(*number) {
                    Node::Product(_) => length(number),
                    _ => factor(number),
                };
                let bar = if matches!(self.node(*below), Node::Product(_)) { "/()" } else { "/" };
                side(above) + bar.len() + side(below)
            }
            Node::Power(base, exponent) => {
                let base = self.within_brackets(*base, |node| matches!(node, Node::Product(_) | Node::Power(..)));
                base + "^".len() + exponent.to_string().len()
            }
            Node::Call(function, parts) => function.name().len() + arguments(parts),
            Node::External(name, order, parts) => name.len() + order + arguments(parts),
            Node::Multiple(one, other) => factor(one) + "*".len() + factor(other),
            Node::AtMost(parts) => list(parts, &length, " <= "),
            Node::NonZero(inside) => length(inside) + " != 0".len(),
            Node::Exists(inside) => length(inside) + " exists".len(),
        }
    }

    /// The length of a node, in brackets if it is a sum, a fraction or one of these.
    fn within_brackets(&self, number: Number, has_brackets: fn(&Node) -> bool) -> usize {
        let node = self.node(number);
        let brackets = if matches!(node, Node::Sum(_) | Node::Quotient(..)) || has_brackets(node) { "()" } else { "" };
        self.length(number) + brackets.len()
    }
}

impl Node {
    /// Visits the numbers of its parts.
    fn each(&mut self, visit: &mut dyn FnMut(&mut Number)) {
        match self {
            Self::Name(_) | Self::Integer(_) | Self::Decimal(_) | Self::Pi | Self::Ellipsis => {}
            Self::Rate(part)
            | Self::Acceleration(part)
            | Self::Determinant(part)
            | Self::Inverse(part)
            | Self::Power(part, _)
            | Self::NonZero(part)
            | Self::Exists(part) => visit(part),
            Self::Ratio(one, other) | Self::Quotient(one, other) | Self::Multiple(one, other) => {
                [one, other].into_iter().for_each(visit);
            }
            Self::RatioDerivative(of, by) => {
                visit(of);
                by.iter_mut().for_each(visit);
            }
            Self::Sum(terms) => terms.iter_mut().for_each(|(_, term)| visit(term)),
            Self::Product(parts) | Self::Call(_, parts) | Self::External(_, _, parts) | Self::AtMost(parts) => {
                parts.iter_mut().for_each(visit);
            }
        }
    }
}

/// The name of J, or of the block of J with this number.
fn matrix_name(group: Option<usize>) -> String {
    group.map_or_else(|| "J".to_owned(), |group| format!("J{group}"))
}
