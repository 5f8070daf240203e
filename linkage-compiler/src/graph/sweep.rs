//! What an expression is made of: sweeps whose cost is that of what they find, not of the graph.

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
        // Children have smaller ids than their parents.
        let mut size = 0;
        for root in roots {
            size = size.max(root.index() + 1);
        }
        let mut seen = vec![false; size].into_boxed_slice();
        let (mut found, mut lowest) = (Vec::with_capacity(16 + roots.len()), size);
        let mut find = |id: NodeId, found: &mut Vec<NodeId>| {
            let index = id.index();
            if !seen[index] && !done(id) {
                seen[index] = true;
                lowest = lowest.min(index);
                found.push(id);
            }
        };
        for &root in roots {
            find(root, &mut found);
        }
        let mut next = 0;
        while let Some(&id) = found.get(next) {
            next += 1;
            if !leaf(id) {
                self.each_child(id, |child| find(child, &mut found));
            }
        }
        in_order(&mut found, &seen, lowest);
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

/// Puts the nodes that were found, which are those `seen`, in ascending order.
fn in_order(found: &mut [NodeId], seen: &[bool], lowest: usize) {
    /// So many looks cost as much as it takes to sort one node.
    const LOOKS: usize = 16;
    if seen.len() - lowest > LOOKS * found.len() {
        found.sort_unstable();
        return;
    }
    let (mut index, mut next) = (lowest, 0);
    while next < found.len() {
        if seen[index] {
            found[next] = NodeId::new(index);
            next += 1;
        }
        index += 1;
    }
}
