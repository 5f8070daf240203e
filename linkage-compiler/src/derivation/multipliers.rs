//! The Lagrange multipliers of the loop equations and constraints.
//!
//! The rows of the unknowns in `M q'' + Psi_q' lambda = F` give `J' lambda = F_u - (M q'')_u`. This is solved from the
//! last group to the first, each block of J transposed. For a `loop`, lambda is the force of the left side on the right
//! side at the point where they meet.
//!
//! The rows of Psi may be those of an elimination, row j less m times row i. With lambda_i - sum m lambda_j in place of
//! lambda_i, `Psi_q'` lambda is that of the rows as written.

use rustc_hash::FxHashMap;

use super::data::Derivation;
use super::jacobian::along_rates;
use super::linear::{Form, solve_closed};
use super::scene::Multipliers;
use super::step::Step;
use crate::graph::{Function, NodeId, Number, SymbolId};
use crate::ids::{Id, RowId, Table};
use crate::model::{self, Mechanism};

impl Derivation {
    pub(super) fn derive_multipliers(
        &mut self,
        mechanism: &Mechanism,
        scene: &model::Scene,
        contact_forces: &[SymbolId],
    ) -> Multipliers {
        let mut terms = self.unknowns.filled(Vec::new());
        let mut add = |derivation: &mut Self, scalar: NodeId, force: NodeId, sign: Number| {
            let row = derivation.row_of(scalar);
            for (terms, unknown) in terms.iter_mut().zip(&derivation.unknowns) {
                if let Some(&entry) = row.get(unknown) {
                    terms.push((sign, derivation.graph.multiply(entry, force)));
                }
            }
        };
        for (index, body) in mechanism.bodies.enumerated() {
            for part in self.moving_parts(index, body, scene) {
                for (&scalar, &field) in part.scalars.iter().zip(&part.fields) {
                    let acceleration = if part.is_inert { self.acceleration_of(scalar) } else { self.graph.zero() };
                    let difference = self.graph.subtract(acceleration, field);
                    let force = self.graph.multiply(part.factor, difference);
                    add(self, scalar, force, Number::MINUS_ONE);
                }
            }
        }
        for law in &scene.laws {
            add(self, law.along, law.law, Number::ONE);
        }
        for (contact, &force) in scene.contacts.iter().zip(contact_forces) {
            let force = self.graph.variable(force);
            add(self, contact.along, force, Number::ONE);
        }
        let side = terms.map(|terms| self.graph.sum(&terms));
        let names: Table<RowId, SymbolId> =
            self.residual.ids().map(|row| self.graph.symbol(format!("lambda_{}", row.number()))).collect();
        let eliminations = mechanism.drivers[scene.driver].system.eliminations.clone();
        let mut solved = names.clone();
        for elimination in &eliminations {
            let row = elimination.pivot;
            solved[row] = self.graph.symbol(format!("lambda_{}_eliminated", row.number()));
        }
        Multipliers { names, solved, eliminations, side }
    }

    /// `s''` in terms of q, `q'` and `q''`.
    pub(super) fn acceleration_of(&mut self, scalar: NodeId) -> NodeId {
        let mut seeds = along_rates(&mut self.graph, &self.coordinates);
        let rate = self.graph.differentiate(&[scalar], &seeds)[0];
        for coordinate in &self.coordinates {
            seeds.insert(coordinate.rate, self.graph.variable(coordinate.acceleration));
        }
        self.graph.differentiate(&[rate], &seeds)[0]
    }

    /// The steps that check each group and solve J' lambda = side.
    pub fn transposed_solution(&mut self, multipliers: &Multipliers) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut solved: Vec<(RowId, NodeId)> = Vec::new();
        for id in self.groups.ids().rev() {
            let group = self.groups[id].clone();
            let rows = self.block_matrix(&group);
            let columns = |index: usize| rows.iter().map(|row| row[index]).collect::<Vec<NodeId>>();
            let matrix: Vec<Vec<NodeId>> = (0..rows.len()).map(columns).collect();
            let mut right = Vec::new();
            for &unknown in &group.unknowns {
                let mut terms = vec![(Number::ONE, multipliers.side[unknown])];
                for &(equation, lambda) in &solved {
                    if let Some(&entry) = self.jacobian[equation].get(&self.unknowns[unknown]) {
                        terms.push((Number::MINUS_ONE, self.graph.multiply(entry, lambda)));
                    }
                }
                right.push(self.graph.sum(&terms));
            }
            let targets = multipliers.solved.at(&group.equations);
            if group.determinant.is_some() {
                if let Some(divisor) = self.check_group(id, &group, &mut steps) {
                    let values = solve_closed(&mut self.graph, &matrix, divisor, &right, Form::Entries);
                    let named = targets.iter().zip(values);
                    steps.extend(named.map(|(&symbol, node)| Step::Let { symbol, node }));
                }
            } else {
                let row_scales = matrix.iter().map(|row| self.row_scale(row)).collect();
                steps.push(Step::Factor { group: id, matrix, row_scales });
                steps.push(Step::Solve { group: id, targets: targets.clone(), right });
            }
            solved.extend(group.equations.iter().zip(targets).map(|(&at, name)| (at, self.graph.variable(name))));
        }
        steps.extend(self.as_written(multipliers));
        steps
    }

    /// The steps that name the multipliers of the rows as written.
    fn as_written(&mut self, multipliers: &Multipliers) -> Vec<Step> {
        let mut values: Table<RowId, NodeId> =
            multipliers.solved.iter().map(|&symbol| self.graph.variable(symbol)).collect();
        let mut steps = Vec::new();
        for elimination in multipliers.eliminations.iter().rev() {
            let row = elimination.pivot;
            let mut terms = vec![(Number::ONE, values[row])];
            for &(other, multiple) in &elimination.multiples {
                terms.push((Number::MINUS_ONE, self.graph.multiply(multiple, values[other])));
            }
            let node = self.graph.sum(&terms);
            steps.push(Step::Let { symbol: multipliers.names[row], node });
            values[row] = self.graph.variable(multipliers.names[row]);
        }
        steps
    }

    /// An expression in the multipliers of the rows of Psi instead of those as written.
    pub(super) fn in_solved(&mut self, node: NodeId, multipliers: &Multipliers) -> NodeId {
        let names = multipliers.names.iter().zip(&multipliers.solved);
        let mut solved: FxHashMap<NodeId, NodeId> =
            names.map(|(&name, &solved)| (self.graph.variable(name), self.graph.variable(solved))).collect();
        for step in self.as_written(multipliers) {
            if let Step::Let { symbol, node } = step {
                let value = self.graph.replace(&[node], &solved)[0];
                solved.insert(self.graph.variable(symbol), value);
            }
        }
        self.graph.replace(&[node], &solved)[0]
    }

    /// The sum of the magnitudes of the entries of a row.
    fn row_scale(&mut self, row: &[NodeId]) -> NodeId {
        let terms: Vec<_> = row.iter().map(|&entry| (Number::ONE, self.graph.call(Function::Abs, &[entry]))).collect();
        self.graph.sum(&terms)
    }
}
