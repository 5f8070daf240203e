//! Formulas of the velocity ratios: W of each group by Cramer's rule, in terms of the ratios of earlier groups, which
//! keep their names.

use super::data::{Coordinate, Derivation};
use super::linear::{Row, Solutions, System};
use crate::algebra::{cramer, factor};
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::{ColumnId, InputId, Table, UnknownId};

/// Makes the symbols of W.
pub(super) fn names(
    graph: &mut Graph,
    coordinates: &Table<ColumnId, Coordinate>,
    unknowns: &Table<UnknownId, ColumnId>,
    inputs: &Table<InputId, ColumnId>,
) -> Solutions<InputId, SymbolId> {
    let name = |unknown: ColumnId, input: ColumnId| {
        let (of, by) = (&coordinates[unknown].name, &coordinates[input].name);
        if inputs.len() == 1 { format!("{of}_ratio") } else { format!("{of}_by_{by}") }
    };
    inputs.iter().map(|&input| unknowns.iter().map(|&unknown| graph.symbol(name(unknown, input))).collect()).collect()
}

impl Derivation {
    /// W_l = l_u W + l_v of a scalar l with these derivatives, in terms of the symbols of W.
    pub fn quantity_ratio(&mut self, row: &Row<ColumnId>, input: InputId) -> NodeId {
        let mut terms: Vec<_> = row.get(&self.inputs[input]).map(|&entry| (Number::ONE, entry)).into_iter().collect();
        for (unknown, column) in self.unknowns.enumerated() {
            if let Some(&entry) = row.get(column) {
                let ratio = self.graph.variable(self.ratios[input][unknown]);
                terms.push((Number::ONE, self.graph.multiply(entry, ratio)));
            }
        }
        self.graph.sum(&terms)
    }

    /// The simplified formulas of W; `None` in groups that are solved by factorisation.
    pub fn ratio_formulas(&mut self) -> Solutions<InputId, Option<NodeId>> {
        let formulas = self.ratios.ids().map(|input| {
            let system = (self.ratio_side(input), self.ratios[input].clone());
            self.solution_formulas(&system).0
        });
        formulas.collect()
    }

    /// The formulas of x in J x = `side` by Cramer's rule, `None` in groups that are solved by factorisation; and x for
    /// use in later formulas: its symbol or zero.
    pub(super) fn solution_formulas(
        &mut self,
        (side, names): &System,
    ) -> (Table<UnknownId, Option<NodeId>>, Table<UnknownId, NodeId>) {
        let mut formulas = self.unknowns.filled(None);
        let mut solved = Row::new();
        for group in self.groups.clone() {
            let right: Vec<NodeId> =
                group.equations.iter().map(|&equation| self.remainder(equation, side[equation], &solved)).collect();
            let matrix = self.block_matrix(&group);
            let solution: Vec<Option<NodeId>> = match (group.determinant, matrix.as_slice(), right.as_slice()) {
                _ if right.iter().all(|&side| self.graph.is_zero(side)) => right.into_iter().map(Some).collect(),
                (Some(determinant), [_], &[right]) => {
                    let right = factor(&mut self.graph, right);
                    vec![Some(self.graph.divide(right, determinant.value))]
                }
                (Some(determinant), [first, second], &[p, q]) => {
                    let rows = [[first[0], first[1]], [second[0], second[1]]];
                    cramer(&mut self.graph, rows, determinant.value, [p, q]).map(Some).to_vec()
                }
                _ => vec![None; group.unknowns.len()],
            };
            for (&index, formula) in group.unknowns.iter().zip(solution) {
                let still = formula.is_some_and(|formula| self.graph.is_zero(formula));
                let name = self.graph.variable(names[index]);
                solved.insert(self.unknowns[index], if still { self.graph.zero() } else { name });
                formulas[index] = formula;
            }
        }
        let values = self.unknowns.iter().map(|unknown| solved[unknown]).collect();
        (formulas, values)
    }
}
