//! The periods of Psi in each angle.

use std::collections::{BTreeMap, BTreeSet};

use super::data::Derivation;
use crate::graph::{Function, Graph, Node, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, Table};

impl Derivation {
    /// For each coordinate the number of full turns after which Psi repeats; zero if there is none.
    ///
    /// An angle that enters by sines and cosines of p/q of it, in lowest terms, repeats after q turns, and Psi after the
    /// least common multiple of them. A symbol that enters otherwise has no period. A coordinate that does not enter has
    /// the period of one turn.
    #[must_use]
    pub fn periods(&self) -> Table<ColumnId, u32> {
        let graph = &self.graph;
        let is_circular =
            |id: NodeId| matches!(graph.node(id), Node::Call(Function::Sin | Function::Cos | Function::Tan, _));
        let (mut turns, mut bare) = (BTreeMap::<SymbolId, u32>::new(), BTreeSet::new());
        for id in graph.sweep(&self.residual, |_| false, is_circular) {
            match graph.node(id) {
                Node::Symbol(symbol) => {
                    bare.insert(*symbol);
                }
                Node::Call(Function::Sin | Function::Cos | Function::Tan, angle) => {
                    for (symbol, factor) in factors(graph, angle[0]) {
                        let known = turns.get(&symbol).copied().unwrap_or(1);
                        match factor.and_then(turns_of).and_then(|more| common_multiple(known, more)) {
                            Some(all) => drop(turns.insert(symbol, all)),
                            None => drop(bare.insert(symbol)),
                        }
                    }
                }
                _ => {}
            }
        }
        let period = |symbol: SymbolId| {
            if bare.contains(&symbol) { 0 } else { turns.get(&symbol).copied().unwrap_or(1) }
        };
        self.coordinates.iter().map(|coordinate| period(coordinate.value)).collect()
    }
}

/// The symbols of an angle with their factors; `None` for a symbol in a term that is no multiple of it alone.
fn factors(graph: &Graph, angle: NodeId) -> Vec<(SymbolId, Option<Number>)> {
    let of_term = |(factor, term): (Number, NodeId)| match graph.as_symbol(term) {
        Some(symbol) => vec![(symbol, Some(factor))],
        None => graph.symbols_of(&[term]).into_iter().map(|symbol| (symbol, None)).collect(),
    };
    match graph.node(angle) {
        Node::Sum { terms, .. } => terms.iter().copied().flat_map(of_term).collect(),
        Node::Product { coefficient, factors } => match factors.as_slice() {
            &[(base, 1)] => of_term((*coefficient, base)),
            _ => of_term((Number::ONE, angle)),
        },
        _ => of_term((Number::ONE, angle)),
    }
}

/// The least number of full turns of an angle that are full turns of its multiple by a ratio.
fn turns_of(factor: Number) -> Option<u32> {
    match factor {
        Number::Ratio(_, denominator) => u32::try_from(denominator).ok(),
        Number::Float(_) => None,
    }
}

fn common_multiple(one: u32, other: u32) -> Option<u32> {
    let (mut divisor, mut rest) = (one, other);
    while rest != 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    (one / divisor.max(1)).checked_mul(other)
}
