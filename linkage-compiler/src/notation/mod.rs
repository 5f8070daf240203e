//! Formulas as Unicode text, LaTeX and MathML.
//!
//! `layout` turns a node of the graph into terms, fractions and factors in the order of mathematics. `writer`
//! decides what needs brackets, and each notation spells the pieces: `unicode`, `latex`, `mathml`.

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

use crate::graph::{Condition, Graph, NodeId, SymbolId};
pub use formula::Formula;
use latex::Latex;
use layout::{Layout, Sum};
use mathml::MathMl;
pub use name::Name;
use unicode::Unicode;
use writer::{Relation, write};

/// The largest length of a formula, counted in bytes with the names of the `linkage!` language (`theta3` is 6). A
/// longer part is of no use to a reader, and a shared graph can unfold without bound: an ellipsis replaces it. The
/// reader sees about two thirds of this length, 400 characters. With half of it, formulas that fill a line or two of a
/// page are cut; with twice of it, a long formula takes twice the room on the page and in the expansion.
const LONGEST: usize = 600;

/// Writes formulas of one graph; parts that they share are laid out once.
pub struct Printer<'a> {
    graph: &'a Graph,
    names: &'a dyn Fn(SymbolId) -> Name<'a>,
    longest: usize,
    /// The parts that are laid out, by the index of their node.
    parts: Vec<Option<Rc<Sum<'a>>>>,
}

impl<'a> Printer<'a> {
    /// A printer that shows each symbol by the name that `names` gives it.
    #[must_use]
    pub fn new(graph: &'a Graph, names: &'a dyn Fn(SymbolId) -> Name<'a>) -> Self {
        Self { graph, names, longest: LONGEST, parts: Vec::new() }
    }

    /// This printer with another largest length.
    #[must_use]
    pub fn longest(self, bytes: usize) -> Self {
        Self { longest: bytes, ..self }
    }

    /// The formula of this node.
    pub fn formula(&mut self, root: NodeId) -> Formula {
        written(&self.laid_out(root), None)
    }

    /// A condition such as l₄ ≠ 0.
    pub fn condition(&mut self, condition: Condition) -> Formula {
        let (node, relation) = match condition {
            Condition::NonZero(node) => (node, Relation::NotZero),
            Condition::Defined(node) => (node, Relation::Exists),
        };
        written(&self.laid_out(node), Some(relation))
    }

    /// The terms of a node; all parts that it needs are laid out first.
    fn laid_out(&mut self, root: NodeId) -> Rc<Sum<'a>> {
        // Parts have smaller numbers than the nodes that hold them.
        if self.parts.len() <= root.index() {
            self.parts.resize_with(root.index() + 1, || None);
        }
        let missing = self.graph.sweep(&[root], |id| self.parts[id.index()].is_some(), |_| false);
        for id in missing {
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
