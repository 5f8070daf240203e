//! The angles whose directions a pose has at hand.

use std::collections::BTreeSet;

use crate::graph::{Function, Graph, Node, NodeId};

/// The angles whose sines and cosines some expressions take.
pub(super) fn angles(graph: &Graph, roots: &[NodeId]) -> BTreeSet<NodeId> {
    let angle = |id: NodeId| match graph.node(id) {
        Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
        _ => None,
    };
    graph.reachable(roots).into_iter().filter_map(angle).collect()
}
