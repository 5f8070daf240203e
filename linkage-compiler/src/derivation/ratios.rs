//! Velocity ratios as formulas: W of each block by Cramer's rule, in terms of the ratios of the blocks
//! before it, which keep their names.

use super::{Coordinate, Derivation, Row};
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::simplify::{cramer, factor};

/// Names for W, by input and unknown.
pub(super) fn names(
    graph: &mut Graph,
    coordinates: &[Coordinate],
    unknowns: &[usize],
    inputs: &[usize],
) -> Vec<Vec<SymbolId>> {
    let name = |unknown: &usize, input: &usize| {
        let (of, by) = (&coordinates[*unknown].name, &coordinates[*input].name);
        if inputs.len() == 1 { format!("{of}_ratio") } else { format!("{of}_by_{by}") }
    };
    inputs.iter().map(|input| unknowns.iter().map(|unknown| graph.symbol(name(unknown, input))).collect()).collect()
}

impl Derivation {
    /// W_l = l_u W + l_v of a scalar with these derivatives, W by its names.
    pub fn quantity_ratio(&mut self, row: &Row, input: usize) -> NodeId {
        let mut terms: Vec<_> = row.get(&self.inputs[input]).map(|&entry| (Number::ONE, entry)).into_iter().collect();
        for (place, unknown) in self.unknowns.iter().enumerate() {
            if let Some(&entry) = row.get(unknown) {
                let ratio = self.graph.variable(self.ratios[input][place]);
                terms.push((Number::ONE, self.graph.multiply(entry, ratio)));
            }
        }
        self.graph.sum(&terms)
    }

    /// W by input and unknown, each simplified; none where a block is solved by factorisation.
    pub fn ratio_formulas(&mut self) -> Vec<Vec<Option<NodeId>>> {
        (0..self.inputs.len()).map(|input| self.ratio_formulas_of(input)).collect()
    }

    fn ratio_formulas_of(&mut self, input: usize) -> Vec<Option<NodeId>> {
        let mut formulas = vec![None; self.unknowns.len()];
        let side = self.ratio_side(input);
        let mut solved = Row::new();
        for block in self.blocks.clone() {
            let right: Vec<NodeId> =
                block.equations.iter().map(|&equation| self.remainder(equation, side[equation], &solved)).collect();
            let matrix = self.block_matrix(&block);
            let solution: Vec<Option<NodeId>> = match (block.determinant, matrix.as_slice(), right.as_slice()) {
                (Some(determinant), [_], &[right]) => {
                    let right = factor(&mut self.graph, right);
                    vec![Some(self.graph.divide(right, determinant.value))]
                }
                (Some(determinant), [first, second], &[p, q]) => {
                    let rows = [[first[0], first[1]], [second[0], second[1]]];
                    cramer(&mut self.graph, rows, determinant.value, [p, q]).map(Some).to_vec()
                }
                _ => vec![None; block.unknowns.len()],
            };
            for (&place, formula) in block.unknowns.iter().zip(solution) {
                let still = formula.is_some_and(|formula| self.graph.is_zero(formula));
                let name = self.graph.variable(self.ratios[input][place]);
                solved.insert(self.unknowns[place], if still { self.graph.zero() } else { name });
                formulas[place] = formula;
            }
        }
        formulas
    }
}
