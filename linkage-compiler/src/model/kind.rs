//! Inference of the kind of a name, angle or length, from its use.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::diagnostics::Region;
use crate::graph::{Graph, Node, NodeId, Number, SymbolId};
use crate::syntax::{ExpressionId, Unit};

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

/// The kinds of the symbols so far, and where they must agree.
#[derive(Debug, Default)]
pub(super) struct Kinds {
    pub(super) known: BTreeMap<SymbolId, Kind>,
    /// Lengths unless another use says otherwise.
    pub(super) supposed: BTreeSet<SymbolId>,
    /// Lengths by a use that is none in a load: `g` in `gravity (0, -g)` is no length.
    pub(super) of_places: BTreeSet<SymbolId>,
    /// Components of vectors in loops.
    pub(super) lengths_of_loops: BTreeSet<SymbolId>,
    /// The operands of the sums of scalars, and the sides of equations.
    pub(super) sums: Vec<Vec<ExpressionId>>,
    /// The angles of bodies, with their places and the names of the bodies.
    pub(super) angles_of_bodies: Vec<(NodeId, Region, String)>,
}

impl Kinds {
    pub(super) fn of(&self, symbol: SymbolId) -> Kind {
        match self.known.get(&symbol) {
            Some(kind) => *kind,
            None if self.supposed.contains(&symbol) => Kind::Length,
            None => Kind::Number,
        }
    }
}

/// The quantity of a parameter, as far as it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Measure {
    /// Not known: a ratio, a mass, a load.
    #[default]
    Number,
    /// Radians.
    Angle,
    /// The rate of an angle, in radians per second: its default is written in `rpm`.
    Rate,
    /// The unit of all lengths.
    Length,
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Number => "number",
            Self::Angle => "angle in radians",
            Self::Rate => "rate of an angle in rad/s",
            Self::Length => "length",
        })
    }
}

impl Kinds {
    /// The quantity of a parameter whose default has this unit.
    pub(super) fn measure(&self, symbol: SymbolId, unit: Unit) -> Measure {
        match (self.of(symbol), unit) {
            (Kind::Angle, _) | (_, Unit::Degrees | Unit::Radians) => Measure::Angle,
            (_, Unit::TurnsPerMinute) => Measure::Rate,
            (Kind::Length, Unit::None) if self.of_places.contains(&symbol) => Measure::Length,
            _ => Measure::Number,
        }
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
