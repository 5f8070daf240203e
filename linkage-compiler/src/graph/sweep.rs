//! What an expression is made of: sweeps whose cost is that of what they find, not of the graph.

use rustc_hash::FxHashSet;

use super::{Function, Graph, Node, NodeId, Number, SymbolId};

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

    /// The symbols whose numbers the roots depend on: not those that enter by whole multiples in sines and cosines
    /// alone, where a direction is enough.
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

    /// The parts of an angle that are not whole multiples of a symbol.
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
        self.budget.spend(found.len());
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
