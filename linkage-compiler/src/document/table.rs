//! The nodes of formulas, each once.

use linkage_ir::document::{FormulaId, FormulaNode, FormulaNodes, Part};
use rustc_hash::FxHashMap;

use super::name::Name;
use crate::graph::Function;

/// A node as a key: with its names and parts.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    Name(String),
    Rate(FormulaId),
    Acceleration(FormulaId),
    Ratio(FormulaId, FormulaId),
    RatioDerivative(FormulaId, [FormulaId; 2]),
    Determinant(FormulaId),
    Inverse(FormulaId),
    Integer(u64),
    /// A number by its bits.
    Decimal(u64),
    Pi,
    Ellipsis,
    /// Terms, each with true if it is subtracted.
    Sum(Vec<(bool, FormulaId)>),
    Product(Vec<FormulaId>),
    Quotient(FormulaId, FormulaId),
    Power(FormulaId, u32),
    Call(Function, Vec<FormulaId>),
    /// A user function and the order of its derivative.
    External(String, usize, Vec<FormulaId>),
    /// A product of two with a sign between them in every notation.
    Multiple(FormulaId, FormulaId),
    AtMost(Vec<FormulaId>),
    NonZero(FormulaId),
    Exists(FormulaId),
}

/// A flat table of nodes, each of which refers to nodes before it.
#[derive(Debug, Clone, Default)]
pub struct Table {
    nodes: Vec<Node>,
    numbers: FxHashMap<Node, FormulaId>,
    /// The length of each node in bytes with the names of the `linkage!` language: `-l3*sin(theta3 - theta4)` is 24.
    lengths: Vec<usize>,
}

impl Table {
    /// The number of a node, which is added if it is new.
    pub fn add(&mut self, node: Node) -> FormulaId {
        if let Some(number) = self.numbers.get(&node) {
            return *number;
        }
        let number = FormulaId::new(self.nodes.len());
        let length = self.length_of(&node);
        self.numbers.insert(node.clone(), number);
        self.nodes.push(node);
        self.lengths.push(length);
        number
    }

    pub(super) fn node(&self, number: FormulaId) -> &Node {
        &self.nodes[index(number)]
    }

    pub(super) fn length(&self, number: FormulaId) -> usize {
        self.lengths[index(number)]
    }

    /// A quantity.
    pub fn plain(&mut self, name: &str) -> FormulaId {
        self.add(Node::Name(name.to_owned()))
    }

    /// A name, or a derivative of one.
    pub fn name(&mut self, name: Name<'_>) -> FormulaId {
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
    pub fn decimal(&mut self, value: f64) -> FormulaId {
        self.add(Node::Decimal(value.to_bits()))
    }

    /// The terms; a single one that is not subtracted is the sum.
    pub(super) fn sum(&mut self, terms: Vec<(bool, FormulaId)>) -> FormulaId {
        match terms.as_slice() {
            [(false, only)] => *only,
            _ => self.add(Node::Sum(terms)),
        }
    }

    /// The factors; a single one is the product.
    pub(super) fn product(&mut self, factors: Vec<FormulaId>) -> FormulaId {
        match factors.as_slice() {
            [only] => *only,
            _ => self.add(Node::Product(factors)),
        }
    }

    /// The nodes that a record needs, in the same order; its numbers change.
    pub(super) fn reduced(self, record: &mut impl Part) -> FormulaNodes {
        let mut is_needed = vec![false; self.nodes.len()];
        record.each(&mut |id| is_needed[index(*id)] = true);
        for (at, node) in self.nodes.iter().enumerate().rev() {
            if is_needed[at] {
                node.clone().each(&mut |part| is_needed[index(*part)] = true);
            }
        }
        let mut count = 0;
        let ids: Vec<FormulaId> = is_needed
            .iter()
            .map(|is_needed| {
                let id = FormulaId::new(count);
                count += usize::from(*is_needed);
                id
            })
            .collect();
        let mut nodes = FormulaNodes::default();
        for (mut node, is_needed) in self.nodes.into_iter().zip(is_needed) {
            if is_needed {
                node.each(&mut |part| *part = ids[index(*part)]);
                add(&mut nodes, node);
            }
        }
        record.each(&mut |id| *id = ids[index(*id)]);
        nodes
    }

    /// All nodes.
    #[must_use]
    pub fn nodes(&self) -> FormulaNodes {
        let mut nodes = FormulaNodes::default();
        self.nodes.iter().for_each(|node| add(&mut nodes, node.clone()));
        nodes
    }

    /// The length of a formula.
    fn length_of(&self, node: &Node) -> usize {
        let length = |number: &FormulaId| self.length(*number);
        let list = |parts: &[FormulaId], length: &dyn Fn(&FormulaId) -> usize, between: &str| {
            parts.iter().map(length).sum::<usize>() + between.len() * parts.len().saturating_sub(1)
        };
        let arguments = |arguments: &[FormulaId]| list(arguments, &length, ", ") + "()".len();
        let factor = |number: &FormulaId| self.within_brackets(*number, |node| matches!(node, Node::Product(_)));
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
                let term = |(_, number): &(bool, FormulaId)| match self.node(*number) {
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
                let side = |number: &FormulaId| match self.node(*number) {
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
    fn within_brackets(&self, number: FormulaId, has_brackets: fn(&Node) -> bool) -> usize {
        let node = self.node(number);
        let brackets = if matches!(node, Node::Sum(_) | Node::Quotient(..)) || has_brackets(node) { "()" } else { "" };
        self.length(number) + brackets.len()
    }
}

impl Node {
    /// Visits the numbers of its parts.
    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
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

/// Adds a node: its name and its parts go into lists of their own.
fn add(all: &mut FormulaNodes, node: Node) {
    let FormulaNodes { nodes, names, parts } = all;
    let mut named = |name: String| {
        names.push(name);
        short(names.len() - 1)
    };
    let mut listed = |terms: Vec<(bool, FormulaId)>| {
        let first = parts.len();
        // A longer table is an error where it is checked.
        let number = |id: FormulaId| i32::try_from(id.get()).unwrap_or(i32::MAX);
        parts.extend(terms.into_iter().map(|(is_negative, id)| if is_negative { -number(id) } else { number(id) }));
        [short(first), short(parts.len() - first)]
    };
    let unsigned = |ids: Vec<FormulaId>| ids.into_iter().map(|id| (false, id)).collect::<Vec<_>>();
    nodes.push(match node {
        Node::Name(name) => FormulaNode::Name(named(name)),
        Node::Rate(name) => FormulaNode::Rate(name.get()),
        Node::Acceleration(name) => FormulaNode::Acceleration(name.get()),
        Node::Ratio(of, by) => FormulaNode::Ratio(of.get(), by.get()),
        Node::RatioDerivative(of, [one, other]) => FormulaNode::RatioDerivative(of.get(), one.get(), other.get()),
        Node::Determinant(matrix) => FormulaNode::Determinant(matrix.get()),
        Node::Inverse(matrix) => FormulaNode::Inverse(matrix.get()),
        Node::Integer(value) => FormulaNode::Integer(value),
        Node::Decimal(bits) => FormulaNode::Decimal(f64::from_bits(bits)),
        Node::Pi => FormulaNode::Pi,
        Node::Ellipsis => FormulaNode::Ellipsis,
        Node::Sum(terms) => {
            let [first, count] = listed(terms);
            FormulaNode::Sum(first, count)
        }
        Node::Product(factors) => {
            let [first, count] = listed(unsigned(factors));
            FormulaNode::Product(first, count)
        }
        Node::Quotient(above, below) => FormulaNode::Quotient(above.get(), below.get()),
        Node::Power(base, exponent) => FormulaNode::Power(base.get(), exponent),
        Node::Call(function, arguments) => {
            let [first, count] = listed(unsigned(arguments));
            FormulaNode::Call(function, first, count)
        }
        Node::External(name, order, arguments) => {
            let (name, [first, count]) = (named(name), listed(unsigned(arguments)));
            FormulaNode::External(name, short(order), first, count)
        }
        Node::Multiple(one, other) => FormulaNode::Multiple(one.get(), other.get()),
        Node::AtMost(all) => {
            let [first, count] = listed(unsigned(all));
            FormulaNode::AtMost(first, count)
        }
        Node::NonZero(inside) => FormulaNode::NonZero(inside.get()),
        Node::Exists(inside) => FormulaNode::Exists(inside.get()),
    });
}

/// A longer table is an error where it is checked.
fn short(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

/// The place of a node of a table; its numbers count from 1.
fn index(id: FormulaId) -> usize {
    id.get() as usize - 1
}

/// The name of J, or of the block of J with this number.
fn matrix_name(group: Option<usize>) -> String {
    group.map_or_else(|| "J".to_owned(), |group| format!("J{group}"))
}
