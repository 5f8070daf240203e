//! Substitution.

use rustc_hash::FxHashMap;

use super::arena::Graph;
use super::node::{Node, NodeId};

impl Graph {
    /// Replaces nodes in the roots; replacements are not searched again.
    pub fn replace(&mut self, roots: &[NodeId], by: &FxHashMap<NodeId, NodeId>) -> Vec<NodeId> {
        let mut new = by.clone();
        for id in self.reachable(roots) {
            if !by.contains_key(&id) {
                let rebuilt = self.rebuilt(id, &new);
                new.insert(id, rebuilt);
            }
        }
        roots.iter().map(|root| new[root]).collect()
    }

    /// Rebuilds a node with new children, all of which are in `parts`.
    pub(crate) fn rebuilt(&mut self, id: NodeId, parts: &FxHashMap<NodeId, NodeId>) -> NodeId {
        if self.children(id).iter().all(|child| parts[child] == *child) {
            return id;
        }
        match self.node(id).clone() {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => id,
            Node::Sum { constant, terms } => {
                let mut sum: Vec<_> = terms.into_iter().map(|(factor, term)| (factor, parts[&term])).collect();
                sum.push((constant, self.one()));
                self.sum(&sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product: Vec<_> = factors.into_iter().map(|(base, n)| (parts[&base], n)).collect();
                product.push((self.number(coefficient), 1));
                self.product(&product)
            }
            Node::Call(function, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(|argument| parts[argument]).collect();
                self.call(function, &arguments)
            }
            Node::External(external, arguments) => {
                let arguments = arguments.iter().map(|argument| parts[argument]).collect();
                self.apply(external, arguments)
            }
        }
    }
}
