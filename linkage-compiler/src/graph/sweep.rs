//! What an expression is made of: sweeps whose cost is that of what they find, not of the graph.

use rustc_hash::FxHashSet;

use super::{Graph, Node, NodeId, SymbolId};

impl Graph {
    /// The direct parts of a node.
    #[must_use]
    pub fn children(&self, id: NodeId) -> Vec<NodeId> {
        let mut children = Vec::new();
        self.each_child(id, |child| children.push(child));
        children
    }

    /// Every node that the roots are made of, children before parents.
    #[must_use]
    pub fn reachable(&self, roots: &[NodeId]) -> Vec<NodeId> {
        self.sweep(roots, |_| false, |_| false)
    }

    /// The symbols that the roots are made of.
    #[must_use]
    pub fn symbols_of(&self, roots: &[NodeId]) -> Vec<SymbolId> {
        self.reachable(roots).into_iter().filter_map(|id| self.as_symbol(id)).collect()
    }

    /// The nodes that the roots are made of, children before parents, but for those that are `done`; of
    /// a `leaf` nothing more.
    pub(crate) fn sweep(
        &self,
        roots: &[NodeId],
        done: impl Fn(NodeId) -> bool,
        leaf: impl Fn(NodeId) -> bool,
    ) -> Vec<NodeId> {
        let mut seen: FxHashSet<NodeId> = FxHashSet::default();
        let mut found: Vec<NodeId> = roots.iter().copied().filter(|&root| !done(root) && seen.insert(root)).collect();
        let mut next = 0;
        while next < found.len() {
            let id = found[next];
            next += 1;
            if !leaf(id) {
                self.each_child(id, |child| {
                    if !done(child) && seen.insert(child) {
                        found.push(child);
                    }
                });
            }
        }
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
