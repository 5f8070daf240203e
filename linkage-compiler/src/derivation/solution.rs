//! The solution of linear systems in J as steps of a kernel, block by block.

use super::data::{Block, Derivation};
use super::linear::{Form, Row, System, solve_closed};
use super::step::Step;
use crate::graph::NodeId;
use crate::ids::{BlockId, ColumnId, Table, UnknownId};

impl Derivation {
    /// The steps that solve J x = right for several right sides: each block is checked, then solved for all systems.
    ///
    /// A system may use the solution of an earlier one, since each block solves the systems in order.
    pub fn solution(&mut self, systems: &[System], form: Form) -> Vec<Step> {
        self.solve(systems, form).0
    }

    /// The steps of [`solution`](Self::solution), and the solutions: symbols, or zero.
    pub fn solve(&mut self, systems: &[System], form: Form) -> (Vec<Step>, Vec<Table<UnknownId, NodeId>>) {
        let mut steps = Vec::new();
        let mut solved: Vec<Row<ColumnId>> = vec![Row::new(); systems.len()];
        for id in self.blocks.ids() {
            let block = self.blocks[id].clone();
            let divisor = self.check_block(id, &block, &mut steps);
            let matrix = self.block_matrix(&block);
            for ((right, targets), solved) in systems.iter().zip(&mut solved) {
                let right: Vec<NodeId> =
                    block.equations.iter().map(|&equation| self.remainder(equation, right[equation], solved)).collect();
                let targets = targets.at(&block.unknowns);
                let mut solution = targets.iter().map(|&symbol| self.graph.variable(symbol)).collect::<Vec<_>>();
                let formulas = match divisor {
                    _ if right.iter().all(|&side| self.graph.is_zero(side)) => right,
                    Some(divisor) => solve_closed(&mut self.graph, &matrix, divisor, &right, form),
                    None => {
                        steps.push(Step::Solve { block: id, targets: targets.clone(), right });
                        Vec::new()
                    }
                };
                for ((symbol, node), name) in targets.into_iter().zip(formulas).zip(&mut solution) {
                    steps.push(Step::Let { symbol, node });
                    // Later formulas use zero instead of the symbol.
                    if self.graph.is_zero(node) {
                        *name = node;
                    }
                }
                solved.extend(self.unknowns.at(&block.unknowns).into_iter().zip(solution));
            }
        }
        let columns = &self.unknowns;
        let values = solved.iter().map(|solved| columns.iter().map(|column| solved[column]).collect());
        (steps, values.collect())
    }

    /// Adds the check of a block; returns the divisor of its closed form.
    pub(super) fn check_block(&mut self, id: BlockId, block: &Block, steps: &mut Vec<Step>) -> Option<NodeId> {
        let Some(determinant) = block.determinant else {
            let row_scales = self.residual_scales.at(&block.equations);
            steps.push(Step::Factor { block: id, matrix: self.block_matrix(block), row_scales });
            return None;
        };
        // A determinant that is a number other than zero needs no check.
        if self.graph.constant_value(determinant.value).is_some_and(|value| value != 0.0) {
            return Some(determinant.value);
        }
        let node = self.graph.variable(determinant.symbol);
        steps.push(Step::Guard { block: id, determinant: node, scale: determinant.scale });
        Some(node)
    }

    /// The submatrix of J of a block, by rows.
    pub fn block_matrix(&mut self, block: &Block) -> Vec<Vec<NodeId>> {
        let zero = self.graph.zero();
        let columns = self.unknowns.at(&block.unknowns);
        let row = |row: &Row<ColumnId>| columns.iter().map(|column| row.get(column).copied().unwrap_or(zero)).collect();
        block.equations.iter().map(|&equation| row(&self.jacobian[equation])).collect()
    }
}
