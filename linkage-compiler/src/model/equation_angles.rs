//! Angles by equations: a coordinate that an equation adds to an angle is one.

use std::collections::{BTreeMap, BTreeSet};

use super::kind::{Kind, Kinds, bare_symbols};
use super::output_angles::angle;
use crate::graph::{Function, Graph, Node, NodeId, SymbolId};

impl Kinds {
    /// The kinds of all symbols that have one.
    fn all(&self) -> BTreeMap<SymbolId, Kind> {
        let supposed = self.supposed.iter().map(|symbol| (*symbol, Kind::Length));
        supposed.chain(self.known.iter().map(|(symbol, kind)| (*symbol, *kind))).collect()
    }

    /// Finds the coordinates that equations make angles: the terms of a sum are of one kind, and an equation is a sum that is
    /// zero. It counts if its terms are names and numbers, since a product, as of a radius and an angle, may be anything.
    pub(super) fn angles_of_equations(
        &mut self,
        graph: &Graph,
        equations: &[NodeId],
        coordinates: impl IntoIterator<Item = SymbolId>,
    ) {
        let mut kinds = self.all();
        let open: BTreeSet<SymbolId> = coordinates.into_iter().filter(|symbol| !kinds.contains_key(symbol)).collect();
        let mut equations_of: BTreeMap<SymbolId, Vec<NodeId>> = BTreeMap::new();
        let mut left = Vec::new();
        for &equation in equations {
            let symbols: Vec<SymbolId> =
                bare_symbols(graph, equation).into_iter().filter(|symbol| open.contains(symbol)).collect();
            symbols.iter().for_each(|symbol| equations_of.entry(*symbol).or_default().push(equation));
            left.extend((!symbols.is_empty()).then_some(equation));
        }
        while let Some(equation) = left.pop() {
            if !has_simple_terms(graph, equation) || angle(graph, equation, &kinds).is_none() {
                continue;
            }
            for symbol in bare_symbols(graph, equation) {
                if open.contains(&symbol) && kinds.insert(symbol, Kind::Angle).is_none() {
                    self.known.insert(symbol, Kind::Angle);
                    left.extend(equations_of.get(&symbol).into_iter().flatten());
                }
            }
        }
    }
}

/// True for a sum of names times numbers, numbers, and inverse functions.
fn has_simple_terms(graph: &Graph, sum: NodeId) -> bool {
    let is_simple = |id: NodeId| match graph.node(id) {
        Node::Symbol(_) => true,
        Node::Call(function, _) => {
            matches!(function, Function::Asin | Function::Acos | Function::Atan | Function::Atan2)
        }
        _ => graph.constant_value(id).is_some(),
    };
    matches!(graph.node(sum), Node::Sum { terms, .. } if terms.iter().all(|(_, term)| is_simple(*term)))
}
