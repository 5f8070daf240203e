//! Inference of the kind of a name, angle or length, from its use.

use std::fmt;

use crate::graph::{Graph, Node, NodeId, Number, SymbolId};

/// The kind of quantity of a parameter or coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// Used neither as an angle nor as a length.
    #[default]
    Number,
    /// Used after `@` or in a sine: radians.
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

/// The symbols with the same kind as the expression: its terms that are a symbol, possibly times a
/// number. In `r*theta` neither factor has the kind of the product.
pub(super) fn bare_symbols(graph: &Graph, id: NodeId) -> Vec<SymbolId> {
    bare_terms(graph, id).into_iter().map(|(_, symbol)| symbol).collect()
}

/// These symbols with their numbers.
pub(super) fn bare_terms(graph: &Graph, id: NodeId) -> Vec<(Number, SymbolId)> {
    let single = |id: NodeId| match graph.node(id) {
        Node::Symbol(symbol) => Some((Number::ONE, *symbol)),
        Node::Product { coefficient, factors } => match factors.as_slice() {
            &[(base, 1)] => graph.as_symbol(base).map(|symbol| (*coefficient, symbol)),
            _ => None,
        },
        _ => None,
    };
    match graph.node(id) {
        Node::Sum { terms, .. } => {
            let term =
                |&(number, term): &(Number, NodeId)| single(term).map(|(one, symbol)| (number.multiply(one), symbol));
            terms.iter().filter_map(term).collect()
        }
        _ => single(id).into_iter().collect(),
    }
}
