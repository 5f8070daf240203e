//! The cost of an expression, by which simplification chooses among equal ones.

use std::collections::BTreeSet;

use crate::graph::{Function, Graph, Node, NodeId};

/// Operation counts, compared in the order of the fields: functions, divisions, products, then length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost {
    pub functions: usize,
    pub divisions: usize,
    pub multiplications: usize,
    pub additions: usize,
    /// The number of nodes, compared last.
    pub nodes: usize,
}

/// The cost of an expression, each node counted once. The sines and cosines of the angles in `given` cost nothing.
#[must_use]
pub fn cost(graph: &Graph, root: NodeId, given: &BTreeSet<NodeId>) -> Cost {
    let mut total = Cost::default();
    let mut wanted = BTreeSet::from([root]);
    while let Some(id) = wanted.pop_last() {
        if graph.constant_value(id).is_some() {
            continue;
        }
        total.nodes += 1;
        graph.budget().count(1);
        match graph.node(id) {
            Node::Call(Function::Sin | Function::Cos, angle) if given.contains(&angle[0]) => continue,
            // An absolute value costs nothing.
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
