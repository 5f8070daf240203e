//! The nodes of a table: names, parts and numbers apart.

use linkage_compiler::document::{Node, Number, Table};
use linkage_runtime::derivation::{FormulaNode, FormulaTable};

use crate::arena::Arena;
use crate::error::Unsound;

pub(crate) fn lent<'a>(arena: &'a Arena, table: &Table) -> Result<&'a FormulaTable<'a>, Unsound> {
    let mut lists = Lists { arena, names: Vec::new(), parts: Vec::new() };
    let nodes: Result<Vec<FormulaNode>, Unsound> = table.nodes().map(|node| lists.node(node)).collect();
    let (nodes, names, parts) = (arena.copied(&nodes?), arena.copied(&lists.names), arena.copied(&lists.parts));
    let table = FormulaTable::checked(nodes, names, parts).ok_or(Unsound::Table)?;
    Ok(arena.one(table))
}

/// The lists that nodes refer to.
struct Lists<'a> {
    arena: &'a Arena,
    names: Vec<&'a str>,
    parts: Vec<i32>,
}

impl Lists<'_> {
    fn node(&mut self, node: &Node) -> Result<FormulaNode, Unsound> {
        Ok(match node {
            Node::Name(name) => FormulaNode::Name(self.named(name)?),
            Node::Rate(name) => FormulaNode::Rate(name.get()),
            Node::Acceleration(name) => FormulaNode::Acceleration(name.get()),
            Node::Ratio(of, by) => FormulaNode::Ratio(of.get(), by.get()),
            Node::RatioDerivative(of, [one, other]) => FormulaNode::RatioDerivative(of.get(), one.get(), other.get()),
            Node::Determinant(matrix) => FormulaNode::Determinant(matrix.get()),
            Node::Inverse(matrix) => FormulaNode::Inverse(matrix.get()),
            Node::Integer(value) => FormulaNode::Integer(*value),
            Node::Decimal(bits) => FormulaNode::Decimal(f64::from_bits(*bits)),
            Node::Pi => FormulaNode::Pi,
            Node::Ellipsis => FormulaNode::Ellipsis,
            Node::Sum(terms) => {
                let [first, count] = self.listed(terms.iter().copied())?;
                FormulaNode::Sum(first, count)
            }
            Node::Product(factors) => {
                let [first, count] = self.unsigned(factors)?;
                FormulaNode::Product(first, count)
            }
            Node::Quotient(above, below) => FormulaNode::Quotient(above.get(), below.get()),
            Node::Power(base, exponent) => FormulaNode::Power(base.get(), *exponent),
            Node::Call(function, arguments) => {
                let [first, count] = self.unsigned(arguments)?;
                FormulaNode::Call(*function, first, count)
            }
            Node::External(name, order, arguments) => {
                let [first, count] = self.unsigned(arguments)?;
                FormulaNode::External(self.named(name)?, short(*order)?, first, count)
            }
            Node::Multiple(one, other) => FormulaNode::Multiple(one.get(), other.get()),
            Node::AtMost(all) => {
                let [first, count] = self.unsigned(all)?;
                FormulaNode::AtMost(first, count)
            }
            Node::NonZero(inside) => FormulaNode::NonZero(inside.get()),
            Node::Exists(inside) => FormulaNode::Exists(inside.get()),
        })
    }

    /// Adds a name; returns its place.
    fn named(&mut self, name: &str) -> Result<u32, Unsound> {
        self.names.push(self.arena.text(name));
        short(self.names.len() - 1)
    }

    /// Adds parts, each with true if it is subtracted; returns the place of the first, and their number.
    fn listed(&mut self, parts: impl Iterator<Item = (bool, Number)>) -> Result<[u32; 2], Unsound> {
        let first = self.parts.len();
        for (is_negative, part) in parts {
            let number = i32::try_from(part.get()).map_err(|_| Unsound::TooLong)?;
            self.parts.push(if is_negative { -number } else { number });
        }
        Ok([short(first)?, short(self.parts.len() - first)?])
    }

    fn unsigned(&mut self, parts: &[Number]) -> Result<[u32; 2], Unsound> {
        self.listed(parts.iter().map(|part| (false, *part)))
    }
}

fn short(number: usize) -> Result<u32, Unsound> {
    u32::try_from(number).map_err(|_| Unsound::TooLong)
}
