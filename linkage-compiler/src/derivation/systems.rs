//! Linear systems in J: its columns, right sides, determinant, and the effect of a solution on points and outputs.

use std::collections::{BTreeMap, BTreeSet};

use super::data::{Coordinate, Derivation, Quantity};
use super::linear::{Row, System};
use super::scale;
use crate::algebra::gather;
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, Id, InputId, RowId, Table, UnknownId};

impl Quantity {
    /// direct + l_u x for a component l with these derivatives.
    pub(super) fn through_unknowns(
        graph: &mut Graph,
        direct: NodeId,
        row: &Row<ColumnId>,
        unknowns: &Table<UnknownId, ColumnId>,
        x: &Table<UnknownId, NodeId>,
    ) -> NodeId {
        let mut terms = vec![(Number::ONE, direct)];
        for (unknown, &x) in unknowns.iter().zip(x) {
            if let Some(&entry) = row.get(unknown) {
                terms.push((Number::ONE, graph.multiply(entry, x)));
            }
        }
        graph.sum(&terms)
    }
}

impl Derivation {
    /// J, the columns of the unknowns.
    #[must_use]
    pub fn jacobian_unknowns(&self) -> Table<RowId, Row<UnknownId>> {
        self.columns(&self.unknowns)
    }

    /// A, the columns of the inputs.
    #[must_use]
    pub fn jacobian_inputs(&self) -> Table<RowId, Row<InputId>> {
        self.columns(&self.inputs)
    }

    /// Upper bounds of the magnitudes of the entries of J and of A.
    pub fn jacobian_scales(&mut self) -> (Table<RowId, Row<UnknownId>>, Table<RowId, Row<InputId>>) {
        let (unknowns, inputs) = (self.jacobian_unknowns(), self.jacobian_inputs());
        (scales(&mut self.graph, unknowns), scales(&mut self.graph, inputs))
    }

    /// Upper bounds of the magnitudes of the derivatives of the points by some coordinates.
    pub fn point_scales(&mut self, columns: &[ColumnId]) -> Vec<NodeId> {
        let rows = self.points.iter().flat_map(|point| &point.jacobian);
        let entries = rows.flat_map(|row| columns.iter().filter_map(|column| row.get(column).copied()));
        let entries: BTreeSet<NodeId> = entries.collect();
        let scales: BTreeSet<NodeId> = entries.into_iter().map(|entry| scale::of(&mut self.graph, entry)).collect();
        scales.into_iter().collect()
    }

    fn columns<C: Id + Ord>(&self, columns: &Table<C, ColumnId>) -> Table<RowId, Row<C>> {
        let new: BTreeMap<ColumnId, C> = columns.enumerated().map(|(new, &old)| (old, new)).collect();
        let row = |row: &Row<ColumnId>| row.iter().filter_map(|(old, &entry)| Some((*new.get(old)?, entry))).collect();
        self.jacobian.iter().map(row).collect()
    }

    /// -A e_j: the right side of J W_j = -A e_j.
    pub fn ratio_side(&mut self, input: InputId) -> Table<RowId, NodeId> {
        minus_column(&mut self.graph, &self.jacobian, self.inputs[input])
    }

    /// The systems J W_j = -A e_j.
    pub fn ratio_systems(&mut self) -> Table<InputId, System> {
        let ratios = self.ratios.clone();
        ratios.ids().zip(ratios).map(|(input, names)| (self.ratio_side(input), names)).collect()
    }

    /// -A v': the right side of J u' = -A v'.
    pub fn velocity_side(&mut self) -> Table<RowId, NodeId> {
        self.residual.ids().map(|row| self.minus_inputs(row, |c| c.rate, None)).collect()
    }

    /// `-(A v'' + gamma)`: the right side of `J u'' = -(A v'' + gamma)`. Terms with the same product of rates are gathered:
    /// the points of a link have its squared rate in common.
    pub fn acceleration_side(&mut self) -> Table<RowId, NodeId> {
        let rates = self.coordinates.iter().map(|coordinate| self.graph.variable(coordinate.rate)).collect();
        let gamma = self.gamma.clone().map(|gamma| gather(&mut self.graph, gamma, &rates));
        self.residual.ids().map(|row| self.minus_inputs(row, |c| c.acceleration, Some(gamma[row]))).collect()
    }

    pub(super) fn minus_inputs(
        &mut self,
        row: RowId,
        symbol: fn(&Coordinate) -> SymbolId,
        plus: Option<NodeId>,
    ) -> NodeId {
        let mut terms: Vec<_> = plus.map(|term| (Number::MINUS_ONE, term)).into_iter().collect();
        for &column in &self.inputs {
            if let Some(&entry) = self.jacobian[row].get(&column) {
                let rate = self.graph.variable(symbol(&self.coordinates[column]));
                terms.push((Number::MINUS_ONE, self.graph.multiply(entry, rate)));
            }
        }
        self.graph.sum(&terms)
    }

    /// The right side of a group after the unknowns of earlier groups are solved: r - J x, where `solved` holds x by
    /// column.
    pub fn remainder(&mut self, equation: RowId, right: NodeId, solved: &Row<ColumnId>) -> NodeId {
        let mut terms = vec![(Number::ONE, right)];
        for (column, entry) in &self.jacobian[equation] {
            if let Some(&x) = solved.get(column) {
                terms.push((Number::MINUS_ONE, self.graph.multiply(*entry, x)));
            }
        }
        self.graph.sum(&terms)
    }

    /// det J as the product of the determinants of the groups; `None` if a group has more than two unknowns.
    pub fn determinant(&mut self) -> Option<NodeId> {
        let values: Option<Vec<NodeId>> =
            self.groups.iter().map(|group| group.determinant.map(|determinant| determinant.value)).collect();
        let product: Vec<_> = values?.into_iter().map(|value| (value, 1)).collect();
        let product = self.graph.product(&product);
        Some(if self.is_odd { self.graph.negate(product) } else { product })
    }
}

/// Upper bounds of the magnitudes of the entries of some rows.
fn scales<C: Ord>(graph: &mut Graph, rows: Table<RowId, Row<C>>) -> Table<RowId, Row<C>> {
    rows.map(|row| row.into_iter().map(|(column, entry)| (column, scale::of(graph, entry))).collect())
}

/// The negative of a column, as the right side of a system.
pub(super) fn minus_column<C: Ord>(graph: &mut Graph, rows: &Table<RowId, Row<C>>, column: C) -> Table<RowId, NodeId> {
    let zero = graph.zero();
    rows.iter().map(|row| graph.negate(row.get(&column).copied().unwrap_or(zero))).collect()
}
