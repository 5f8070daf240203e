//! The angles in sines and cosines.

use std::collections::BTreeSet;

use crate::graph::{Function, Graph, Node, NodeId};

/// Returns the arguments of all sines and cosines in some expressions.
pub(super) fn angles(graph: &Graph, roots: &[NodeId]) -> BTreeSet<NodeId> {
    let angle = |id: NodeId| match graph.node(id) {
        Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
        _ => None,
    };
    graph.reachable(roots).into_iter().filter_map(angle).collect()
}
