//! Linear systems J x = r of one or two unknowns, by formula.

use crate::graph::{Graph, NodeId};
use crate::simplify::factor;

/// The solution of J x = r where `determinant` is det J:
/// for one unknown x = r / J, for two x = (J_11 r_0 - J_01 r_1, J_00 r_1 - J_10 r_0) / det J.
pub fn solve_closed(graph: &mut Graph, jacobian: &[Vec<NodeId>], determinant: NodeId, right: &[NodeId]) -> Vec<NodeId> {
    match (jacobian, right) {
        ([_], &[r]) => vec![graph.divide(r, determinant)],
        ([top, bottom], &[r0, r1]) => {
            let mut cramer = |(a, r): (NodeId, NodeId), (b, s): (NodeId, NodeId)| {
                let (left, right) = (graph.multiply(a, r), graph.multiply(b, s));
                let numerator = graph.subtract(left, right);
                let numerator = factor(graph, numerator);
                graph.divide(numerator, determinant)
            };
            vec![cramer((bottom[1], r0), (top[1], r1)), cramer((top[0], r1), (bottom[0], r0))]
        }
        _ => Vec::new(),
    }
}
