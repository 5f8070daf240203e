//! Whether a name is an angle or a length, from how it is used.

use std::fmt;

use crate::graph::{Graph, Node, NodeId, SymbolId};

/// What a parameter or a coordinate measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// Used neither as an angle nor as a modulus.
    #[default]
    Number,
    /// Used behind `@` or in a sine: radians.
    Angle,
    /// Used before `@` or as a component.
    Length,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Number => "number",
            Self::Angle => "angle in radians",
            Self::Length => "length",
        })
    }
}

/// The symbols that have the kind of the expression itself: those that stand in it alone, times a
/// number at most. In `r*theta` neither factor has the kind of the product.
pub(super) fn bare_symbols(graph: &Graph, id: NodeId) -> Vec<SymbolId> {
    let single = |id: NodeId| match graph.node(id) {
        Node::Symbol(symbol) => Some(*symbol),
        Node::Product { factors, .. } => match factors.as_slice() {
            &[(base, 1)] => graph.as_symbol(base),
            _ => None,
        },
        _ => None,
    };
    match graph.node(id) {
        Node::Sum { terms, .. } => terms.iter().filter_map(|(_, term)| single(*term)).collect(),
        _ => single(id).into_iter().collect(),
    }
}
