//! Types of linear systems J x = r, and the formula for one or two unknowns.

use std::collections::BTreeMap;

use super::assembly::Assembly;
use crate::algebra::factor;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{RowId, Table, UnknownId};

/// The derivatives of one scalar by coordinates or parameters; missing entries are zero.
pub type Row<Column> = BTreeMap<Column, NodeId>;

/// The solutions x of several systems J x = r.
pub type Solutions<I, X> = Table<I, Table<UnknownId, X>>;

/// J x = r: the right side r, and the symbols of x.
pub type System = (Table<RowId, NodeId>, Table<UnknownId, SymbolId>);

/// The form of the solution of two equations.
#[derive(Debug, Clone, Copy)]
pub enum Form<'a> {
    /// With common factors taken out: fewest operations for a single system.
    Factored,
    /// In terms of the entries of J: fewest operations if the right side has the same entries, as for
    /// accelerations (l_i cos theta_i occurs in both).
    Entries,
    /// By the entries of J^-1, which are named, in terms of the links that the assembly has solved: fewest operations
    /// between det J and the solutions of several systems, since no solution is divided.
    Inverse(&'a Assembly),
}

/// The solution of J x = r where `determinant` is det J:
/// for one unknown x = r / J, for two x = (J_11 r_0 - J_01 r_1, J_00 r_1 - J_10 r_0) / det J.
pub fn solve_closed(
    graph: &mut Graph,
    jacobian: &[Vec<NodeId>],
    determinant: NodeId,
    right: &[NodeId],
    form: Form<'_>,
) -> Vec<NodeId> {
    match (jacobian, right) {
        ([_], &[r]) => vec![graph.divide(r, determinant)],
        ([top, bottom], &[r0, r1]) => {
            let mut cramer = |(a, r): (NodeId, NodeId), (b, s): (NodeId, NodeId)| {
                let (left, right) = (graph.multiply(a, r), graph.multiply(b, s));
                let numerator = graph.subtract(left, right);
                let numerator = if matches!(form, Form::Factored) { factor(graph, numerator) } else { numerator };
                graph.divide(numerator, determinant)
            };
            vec![cramer((bottom[1], r0), (top[1], r1)), cramer((top[0], r1), (bottom[0], r0))]
        }
        _ => Vec::new(),
    }
}
