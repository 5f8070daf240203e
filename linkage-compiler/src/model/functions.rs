//! The functions of vectors, and powers: values from the values of the operands.

use crate::graph::{Function, Graph, LARGEST_EXPONENT, NodeId, Number};

/// The functions of the language besides the operation table, with their number of arguments.
pub const VECTOR_FUNCTIONS: [(&str, usize); 7] =
    [("x", 1), ("y", 1), ("norm", 1), ("angle", 1), ("dot", 2), ("cross", 2), ("powi", 2)];

/// The value of a function of vectors; `None` if there is none of this name and number of arguments.
pub(super) fn of_vectors(graph: &mut Graph, name: &str, vectors: &[[NodeId; 2]]) -> Option<NodeId> {
    let node = match (name, vectors) {
        ("x", &[[x, _]]) => x,
        ("y", &[[_, y]]) => y,
        ("norm", &[[x, y]]) => graph.call(Function::Hypot, &[x, y]),
        ("angle", &[[x, y]]) => graph.call(Function::Atan2, &[y, x]),
        // ax bx + ay by
        ("dot", &[[x, y], [u, v]]) => {
            let (left, right) = (graph.multiply(x, u), graph.multiply(y, v));
            graph.add(left, right)
        }
        // ax by - ay bx
        ("cross", &[[x, y], [u, v]]) => {
            let (left, right) = (graph.multiply(x, v), graph.multiply(y, u));
            graph.subtract(left, right)
        }
        _ => return None,
    };
    Some(node)
}

/// A power whose exponent is an integer that a power can have.
pub(super) fn power(graph: &mut Graph, base: NodeId, exponent: NodeId) -> Option<NodeId> {
    let exponent = graph.as_number(exponent).and_then(Number::as_integer).and_then(|n| i32::try_from(n).ok())?;
    (exponent.unsigned_abs() <= LARGEST_EXPONENT.unsigned_abs()).then(|| graph.power(base, exponent))
}
