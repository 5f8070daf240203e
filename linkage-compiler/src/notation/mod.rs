//! Formulas as Unicode text, LaTeX and MathML.
//!
//! `layout` converts a node of the graph to terms, fractions and factors. `writer` decides on brackets. The modules
//! `unicode`, `latex` and `mathml` implement the notations.

mod formula;
mod latex;
mod layout;
mod mathml;
mod name;
mod spelled;
mod style;
#[cfg(test)]
mod tests;
mod unicode;
mod writer;

use std::rc::Rc;

use crate::graph::{Condition, Function, Graph, Node, NodeId, SymbolId};
pub use formula::Formula;
use latex::Latex;
use layout::{Layout, Sum};
use mathml::MathMl;
pub use name::{Name, greek_name};
use unicode::Unicode;
use writer::{Relation, write};

/// The largest length of a formula, in bytes with the names of the `linkage!` language (`theta3` is 6); an ellipsis
/// replaces a longer part. The formula of a graph with shared nodes can be exponentially long. The printed length is
/// about two thirds of this, 400 characters. With half of it, formulas of one or two lines are cut; with twice of it, a
/// long formula takes twice the space on the page and in the expansion.
const LONGEST: usize = 600;

/// Prints formulas of one graph; shared subexpressions are laid out once.
pub struct Printer<'a> {
    graph: &'a Graph,
    names: &'a dyn Fn(SymbolId) -> Name<'a>,
    longest: usize,
    /// The laid out subexpressions, by node index.
    parts: Vec<Option<Rc<Sum<'a>>>>,
}

impl<'a> Printer<'a> {
    /// A printer; `names` returns the name of each symbol.
    #[must_use]
    pub fn new(graph: &'a Graph, names: &'a dyn Fn(SymbolId) -> Name<'a>) -> Self {
        Self { graph, names, longest: LONGEST, parts: Vec::new() }
    }

    /// This printer with another largest length.
    #[must_use]
    pub fn longest(self, bytes: usize) -> Self {
        Self { longest: bytes, ..self }
    }

    /// Prints a node.
    pub fn formula(&mut self, root: NodeId) -> Formula {
        written(&self.laid_out(root), None)
    }

    /// Prints a condition such as l₄ ≠ 0.
    pub fn condition(&mut self, condition: Condition) -> Formula {
        let (node, relation) = match condition {
            Condition::NonZero(node) => (node, Relation::NotZero),
            Condition::Defined(node) => (node, Relation::Exists),
        };
        written(&self.laid_out(node), Some(relation))
    }

    /// Lays out a node and all its subexpressions.
    fn laid_out(&mut self, root: NodeId) -> Rc<Sum<'a>> {
        // Children have smaller ids than their parents.
        if self.parts.len() <= root.index() {
            self.parts.resize_with(root.index() + 1, || None);
        }
        let missing = self.graph.sweep(&[root], |id| self.parts[id.index()].is_some(), |_| false);
        for id in missing {
            // A reader takes the limit of v where v is 0 / 0.
            if let Node::Call(Function::IfNonzero, arguments) = self.graph.node(id) {
                self.parts[id.index()] = self.parts[arguments[1].index()].clone();
                continue;
            }
            let sum = Layout { graph: self.graph, names: self.names, parts: &self.parts }.sum(id);
            let fits = sum.length() <= self.longest;
            self.parts[id.index()] = Some(Rc::new(if fits { sum } else { Sum::ellipsis() }));
        }
        self.parts[root.index()].clone().unwrap_or_else(|| Rc::new(Sum::ellipsis()))
    }
}

fn written(sum: &Sum<'_>, relation: Option<Relation>) -> Formula {
    Formula {
        text: write(&Unicode, sum, relation),
        latex: write(&Latex, sum, relation),
        mathml: write(&MathMl, sum, relation),
    }
}
