//! The cost of an expression, which decides which of two equal ones is kept.

use std::collections::BTreeSet;

use crate::graph::{Function, Graph, Node, NodeId};

/// Work in the order in which it weighs: a sine is worth many divisions, a division many products.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost {
    pub functions: usize,
    pub divisions: usize,
    pub multiplications: usize,
    pub additions: usize,
    /// The length, which decides between expressions of equal work.
    pub nodes: usize,
}

/// The cost of an expression in which everything shared is computed once. The sines and cosines of
/// the angles in `given` cost nothing.
#[must_use]
pub fn cost(graph: &Graph, root: NodeId, given: &BTreeSet<NodeId>) -> Cost {
    let mut total = Cost::default();
    let mut wanted = BTreeSet::from([root]);
    while let Some(id) = wanted.pop_last() {
        if graph.constant_value(id).is_some() {
            continue;
        }
        total.nodes += 1;
        graph.budget().spend(1);
        match graph.node(id) {
            Node::Call(Function::Sin | Function::Cos, angle) if given.contains(&angle[0]) => continue,
            // Taking a sign away costs nothing.
            Node::Call(Function::Abs, _) => {}
            Node::Call(..) | Node::External(..) => total.functions += 1,
            Node::Sum { constant, terms } => {
                total.additions += terms.len() - usize::from(constant.is_zero());
                total.multiplications += terms.iter().filter(|(factor, _)| !factor.absolute().is_one()).count();
            }
            Node::Product { coefficient, factors } => {
                let count = |above: bool| -> usize {
                    let side = factors.iter().filter(|(_, n)| (*n > 0) == above);
                    side.map(|(_, n)| 1 + (n.unsigned_abs().ilog2() + n.count_ones() - 1) as usize).sum()
                };
                let (above, below) = (count(true) + usize::from(!coefficient.absolute().is_one()), count(false));
                total.multiplications += above.saturating_sub(1) + below.saturating_sub(1);
                total.divisions += usize::from(below > 0);
            }
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => {}
        }
        wanted.extend(graph.children(id));
    }
    total
}
