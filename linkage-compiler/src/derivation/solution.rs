//! Linear systems in J as the steps of a kernel: the blocks in order, each by its own method.

use super::step::Step;
use super::{Block, Derivation, Form, Row, solve_closed};
use crate::graph::{NodeId, SymbolId};

impl Derivation {
    /// Steps that solve J x = right for each right side and name the solutions, block by block, each
    /// after the check of it.
    ///
    /// A later system may refer to the solution of an earlier one: within a block they stand in order.
    pub fn solution(&mut self, systems: &[(Vec<NodeId>, Vec<SymbolId>)], form: Form) -> Vec<Step> {
        self.solve(systems, form).0
    }

    /// The same steps, and each solution by unknown: its names, or zero where nothing moves.
    pub fn solve(&mut self, systems: &[(Vec<NodeId>, Vec<SymbolId>)], form: Form) -> (Vec<Step>, Vec<Vec<NodeId>>) {
        let mut steps = Vec::new();
        let mut solved: Vec<Row> = vec![Row::new(); systems.len()];
        for number in 0..self.blocks.len() {
            let block = self.blocks[number].clone();
            let divisor = self.judge(number, &block, &mut steps);
            let matrix = self.block_matrix(&block);
            for ((right, targets), solved) in systems.iter().zip(&mut solved) {
                let right: Vec<NodeId> =
                    block.equations.iter().map(|&equation| self.remainder(equation, right[equation], solved)).collect();
                let targets: Vec<SymbolId> = block.unknowns.iter().map(|&place| targets[place]).collect();
                let mut solution = targets.iter().map(|&symbol| self.graph.variable(symbol)).collect::<Vec<_>>();
                let formulas = match divisor {
                    _ if right.iter().all(|&side| self.graph.is_zero(side)) => right,
                    Some(divisor) => solve_closed(&mut self.graph, &matrix, divisor, &right, form),
                    None => {
                        steps.push(Step::Solve { block: number, targets: targets.clone(), right });
                        Vec::new()
                    }
                };
                for ((symbol, node), name) in targets.into_iter().zip(formulas).zip(&mut solution) {
                    steps.push(Step::Let { symbol, node });
                    // What does not move needs no name in what follows.
                    if self.graph.is_zero(node) {
                        *name = node;
                    }
                }
                let places = block.unknowns.iter().map(|&place| self.unknowns[place]);
                solved.extend(places.zip(solution));
            }
        }
        let columns = &self.unknowns;
        let values = solved.iter().map(|solved| columns.iter().map(|column| solved[column]).collect());
        (steps, values.collect())
    }

    /// The check of a block, and the divisor of its closed form.
    pub(super) fn judge(&mut self, number: usize, block: &Block, steps: &mut Vec<Step>) -> Option<NodeId> {
        let Some(determinant) = block.determinant else {
            let sizes = block.equations.iter().map(|&equation| self.sizes[equation]).collect();
            steps.push(Step::Factor { block: number, matrix: self.block_matrix(block), sizes });
            return None;
        };
        // A determinant that is a number other than zero needs no check.
        if self.graph.constant_value(determinant.value).is_some_and(|value| value != 0.0) {
            return Some(determinant.value);
        }
        let node = self.graph.variable(determinant.symbol);
        steps.push(Step::Guard { block: number, determinant: node, size: determinant.size });
        Some(node)
    }

    /// The block's part of J, row by row.
    pub fn block_matrix(&mut self, block: &Block) -> Vec<Vec<NodeId>> {
        let zero = self.graph.zero();
        let columns: Vec<usize> = block.unknowns.iter().map(|&place| self.unknowns[place]).collect();
        let row = |row: &Row| columns.iter().map(|column| row.get(column).copied().unwrap_or(zero)).collect();
        block.equations.iter().map(|&equation| row(&self.jacobian[equation])).collect()
    }
}
