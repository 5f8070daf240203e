//! Traversals of expressions; their cost is proportional to the nodes found, not to the graph.

use std::collections::BTreeSet;

use rustc_hash::FxHashSet;

use super::arena::Graph;
use super::node::{Node, NodeId, SymbolId};
use super::{Function, Number};

impl Graph {
    /// The children of a node.
    #[must_use]
    pub fn children(&self, id: NodeId) -> Vec<NodeId> {
        let mut children = Vec::new();
        self.each_child(id, |child| children.push(child));
        children
    }

    /// Every node in the roots, children before parents.
    #[must_use]
    pub fn reachable(&self, roots: &[NodeId]) -> Vec<NodeId> {
        self.sweep(roots, |_| false, |_| false)
    }

    /// The symbols in the roots.
    #[must_use]
    pub fn symbols_of(&self, roots: &[NodeId]) -> Vec<SymbolId> {
        self.reachable(roots).into_iter().filter_map(|id| self.as_symbol(id)).collect()
    }

    /// True if an expression contains a symbol.
    #[must_use]
    pub fn depends_on(&self, node: NodeId, symbol: SymbolId) -> bool {
        self.symbols_of(&[node]).contains(&symbol)
    }

    /// The symbols that the roots use as numbers. Symbols that enter only as integer multiples in sines and cosines are
    /// not among them: their directions are sufficient.
    #[must_use]
    pub fn needed_as_numbers(&self, roots: &[NodeId]) -> Vec<SymbolId> {
        let (mut needed, mut seen, mut stack) = (Vec::new(), FxHashSet::default(), roots.to_vec());
        while let Some(id) = stack.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.node(id) {
                Node::Symbol(symbol) => needed.push(*symbol),
                Node::Call(Function::Sin | Function::Cos, angle) => stack.extend(self.beyond_whole_multiples(angle[0])),
                _ => stack.extend(self.children(id)),
            }
        }
        needed
    }

    /// The symbols that are arguments of sines and cosines in the roots.
    #[must_use]
    pub fn directions(&self, roots: &[NodeId]) -> BTreeSet<SymbolId> {
        let angles = self.angles(roots);
        angles.into_iter().filter_map(|angle| self.as_symbol(angle)).collect()
    }

    /// The symbols in arguments of sines and cosines in the roots.
    #[must_use]
    pub fn in_directions(&self, roots: &[NodeId]) -> BTreeSet<SymbolId> {
        self.symbols_of(&self.angles(roots)).into_iter().collect()
    }

    /// The arguments of sines and cosines in the roots.
    fn angles(&self, roots: &[NodeId]) -> Vec<NodeId> {
        let calls = self.reachable(roots).into_iter().filter_map(|id| match self.node(id) {
            Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
            _ => None,
        });
        calls.collect()
    }

    /// The parts of an angle that are not integer multiples of a symbol.
    fn beyond_whole_multiples(&self, angle: NodeId) -> Vec<NodeId> {
        let is_whole =
            |coefficient: Number, part: NodeId| coefficient.as_integer().is_some() && self.as_symbol(part).is_some();
        match self.node(angle) {
            Node::Sum { terms, .. } => terms
                .iter()
                .filter(|(coefficient, term)| !is_whole(*coefficient, *term))
                .map(|(_, term)| *term)
                .collect(),
            Node::Product { coefficient, factors } if matches!(factors.as_slice(), &[(base, 1)] if is_whole(*coefficient, base)) => {
                Vec::new()
            }
            _ if is_whole(Number::ONE, angle) => Vec::new(),
            _ => self.children(angle),
        }
    }

    /// The nodes in the roots, children before parents, without `done` nodes and without the children of a `leaf`.
    pub(crate) fn sweep(
        &self,
        roots: &[NodeId],
        done: impl Fn(NodeId) -> bool,
        leaf: impl Fn(NodeId) -> bool,
    ) -> Vec<NodeId> {
        let (mut found, mut stack) = (FxHashSet::default(), roots.to_vec());
        while let Some(id) = stack.pop() {
            if !done(id) && found.insert(id) && !leaf(id) {
                self.each_child(id, |child| stack.push(child));
            }
        }
        self.budget.count(found.len());
        // Children have smaller ids than their parents.
        let mut found: Vec<NodeId> = found.into_iter().collect();
        found.sort_unstable();
        found
    }

    fn each_child(&self, id: NodeId, mut visit: impl FnMut(NodeId)) {
        match self.node(id) {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum { terms, .. } => {
                for (_, term) in terms {
                    visit(*term);
                }
            }
            Node::Product { factors, .. } => {
                for (base, _) in factors {
                    visit(*base);
                }
            }
            Node::Call(_, arguments) | Node::External(_, arguments) => {
                for argument in arguments {
                    visit(*argument);
                }
            }
        }
    }
}
