//! Derivatives by coordinates and parameters, as sparse rows.

use std::collections::BTreeMap;

use super::data::Coordinate;
use super::linear::Row;
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{ColumnId, Id, Table};

/// The id of each symbol in a table.
pub(super) fn places_of<I: Id, T>(table: &Table<I, T>, symbol: fn(&T) -> SymbolId) -> BTreeMap<SymbolId, I> {
    table.enumerated().map(|(place, entry)| (symbol(entry), place)).collect()
}

/// The derivatives of some scalars by these symbols.
pub(super) fn jacobian<C: Id + Ord>(graph: &mut Graph, rows: &[NodeId], places: &BTreeMap<SymbolId, C>) -> Vec<Row<C>> {
    // All rows with one symbol are differentiated together, so that common subexpressions are differentiated once.
    let mut holders: BTreeMap<(SymbolId, C), Vec<usize>> = BTreeMap::new();
    for (index, &row) in rows.iter().enumerate() {
        for symbol in graph.symbols_of(&[row]) {
            if let Some(&place) = places.get(&symbol) {
                holders.entry((symbol, place)).or_default().push(index);
            }
        }
    }
    let mut jacobian = vec![Row::new(); rows.len()];
    for ((symbol, place), of) in holders {
        let held: Vec<NodeId> = of.iter().map(|&index| rows[index]).collect();
        for (index, entry) in of.into_iter().zip(graph.partial(&held, symbol)) {
            if !graph.is_zero(entry) {
                jacobian[index].insert(place, entry);
            }
        }
    }
    jacobian
}

/// The map q -> q', for derivatives with respect to time.
pub(super) fn along_rates(graph: &mut Graph, coordinates: &Table<ColumnId, Coordinate>) -> BTreeMap<SymbolId, NodeId> {
    coordinates.iter().map(|coordinate| (coordinate.value, graph.variable(coordinate.rate))).collect()
}
