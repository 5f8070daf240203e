//! The solution of linear systems in J as steps of a kernel, group by group.

use super::assembly::Assembly;
use super::data::{Derivation, Group};
use super::linear::{Form, Row, System, solve_closed};
use super::plane::dot;
use super::step::Step;
use crate::graph::NodeId;
use crate::ids::{ColumnId, GroupId, Table, UnknownId};

impl Derivation {
    /// The steps that solve J x = right for several right sides: each group is checked, then solved for all systems.
    ///
    /// A system may use the solution of an earlier one, since each group solves the systems in order.
    pub fn solution(&mut self, systems: &[System], form: Form<'_>) -> Vec<Step> {
        self.solve(systems, form).0
    }

    /// The steps of [`solution`](Self::solution), and the solutions: symbols, or zero.
    pub fn solve(&mut self, systems: &[System], form: Form<'_>) -> (Vec<Step>, Vec<Table<UnknownId, NodeId>>) {
        let mut steps = Vec::new();
        let mut solved: Vec<Row<ColumnId>> = vec![Row::new(); systems.len()];
        for id in self.groups.ids() {
            let group = self.groups[id].clone();
            let divisor = self.check_group(id, &group, &mut steps);
            let matrix = self.block_matrix(&group);
            let inverse = match (form, divisor) {
                (Form::Inverse(assembly), Some(divisor)) => {
                    self.named_inverse(assembly, &group, &matrix, divisor, &mut steps)
                }
                _ => None,
            };
            for ((right, targets), solved) in systems.iter().zip(&mut solved) {
                let right: Vec<NodeId> =
                    group.equations.iter().map(|&equation| self.remainder(equation, right[equation], solved)).collect();
                let targets = targets.at(&group.unknowns);
                let mut solution = targets.iter().map(|&symbol| self.graph.variable(symbol)).collect::<Vec<_>>();
                let formulas = match (divisor, inverse) {
                    _ if right.iter().all(|&side| self.graph.is_zero(side)) => right,
                    (Some(_), Some(inverse)) => {
                        let sides = targets.iter().zip(right).map(|(&target, side)| {
                            let name = format!("right_{}", self.graph.symbol_name(target));
                            self.named(&name, side, &mut steps)
                        });
                        let sides: Vec<NodeId> = sides.collect();
                        inverse.map(|row| dot(&mut self.graph, row, [sides[0], sides[1]])).to_vec()
                    }
                    (Some(divisor), None) => solve_closed(&mut self.graph, &matrix, divisor, &right, form),
                    (None, _) => {
                        steps.push(Step::Solve { group: id, targets: targets.clone(), right });
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
                solved.extend(self.unknowns.at(&group.unknowns).into_iter().zip(solution));
            }
        }
        let columns = &self.unknowns;
        let values = solved.iter().map(|solved| columns.iter().map(|column| solved[column]).collect());
        (steps, values.collect())
    }

    /// Names the entries of J^-1 of two unknowns, by rows: (J_11, -J_01; -J_10, J_00) / det J. `None` if an entry of J is
    /// a number, which would make products of more factors.
    fn named_inverse(
        &mut self,
        assembly: &Assembly,
        group: &Group,
        matrix: &[Vec<NodeId>],
        divisor: NodeId,
        steps: &mut Vec<Step>,
    ) -> Option<[[NodeId; 2]; 2]> {
        let [top, bottom] = matrix else { return None };
        let (&[a, b], &[c, d]) = (top.as_slice(), bottom.as_slice()) else { return None };
        if [a, b, c, d].into_iter().any(|entry| self.graph.constant_value(entry).is_some()) {
            return None;
        }
        let entries = assembly.solved(&mut self.graph, &[a, b, c, d]);
        let &[a, b, c, d] = entries.as_slice() else { return None };
        let names = self.unknowns.at(&group.unknowns);
        let names = [names[0], names[1]].map(|column| self.coordinates[column].name.clone());
        let (minus_b, minus_c) = (self.graph.negate(b), self.graph.negate(c));
        let [first, second] = names;
        let mut row = |unknown: String, entries: [NodeId; 2]| {
            [(1, entries[0]), (2, entries[1])].map(|(index, entry)| {
                let entry = self.graph.divide(entry, divisor);
                self.named(&format!("inverse_{unknown}_{index}"), entry, steps)
            })
        };
        Some([row(first, [d, minus_b]), row(second, [minus_c, a])])
    }

    /// Names a value unless it is zero.
    fn named(&mut self, name: &str, node: NodeId, steps: &mut Vec<Step>) -> NodeId {
        if self.graph.is_zero(node) {
            return node;
        }
        let symbol = self.graph.symbol(name);
        steps.push(Step::Let { symbol, node });
        self.graph.variable(symbol)
    }

    /// Adds the check of a group; returns the divisor of its closed form.
    pub(super) fn check_group(&mut self, id: GroupId, group: &Group, steps: &mut Vec<Step>) -> Option<NodeId> {
        let Some(determinant) = group.determinant else {
            let row_scales = self.residual_scales.at(&group.equations);
            steps.push(Step::Factor { group: id, matrix: self.block_matrix(group), row_scales });
            return None;
        };
        // A determinant that is a number other than zero needs no check.
        if self.graph.constant_value(determinant.value).is_some_and(|value| value != 0.0) {
            return Some(determinant.value);
        }
        let node = self.graph.variable(determinant.symbol);
        steps.push(Step::Guard { group: id, determinant: node, scale: determinant.scale });
        Some(node)
    }

    /// The submatrix of J of a group, by rows.
    pub fn block_matrix(&mut self, group: &Group) -> Vec<Vec<NodeId>> {
        let zero = self.graph.zero();
        let columns = self.unknowns.at(&group.unknowns);
        let row = |row: &Row<ColumnId>| columns.iter().map(|column| row.get(column).copied().unwrap_or(zero)).collect();
        group.equations.iter().map(|&equation| row(&self.jacobian[equation])).collect()
    }
}
