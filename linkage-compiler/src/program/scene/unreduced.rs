//! `unreduced`: mass matrix and forces in all coordinates.

use std::collections::BTreeMap;

use super::ScenePlan;
use crate::ids::{ColumnId, Id, Table};
use crate::program::doc::lines;
use crate::program::expression::{Expression, Type};
use crate::program::function::{Body, Output, Value, results};
use crate::program::names::Order;

impl ScenePlan<'_, '_, '_> {
    pub(super) fn unreduced(&mut self) {
        let Some(unreduced) = self.scene.unreduced.clone() else { return };
        let (u, v) = (self.plan.signatures.unknowns.len(), self.plan.signatures.inputs.len());
        let names = Table::from(self.plan.fields());
        let inertia = |(row, column): (ColumnId, ColumnId)| match row == column {
            true => format!("{}_inertia", names[row]),
            false => format!("{}_{}_inertia", names[row], names[column]),
        };
        let entries = unreduced.mass_matrix.iter().map(|(&index, &node)| Output::named(node, inertia(index)));
        let forces = unreduced.forces.iter().zip(&names);
        let forces = forces.map(|(&node, name)| Output::named(node, format!("{name}_force")));
        let outputs: Vec<Output> = entries.chain(forces).collect();
        let count = outputs.len();
        let sources = vec![self.plan.coordinates(Order::Rate)];
        let mut body =
            self.on_coordinates(sources, Vec::new(), outputs).checked("the equations of motion", results(0..count));
        let entries: BTreeMap<(ColumnId, ColumnId), usize> =
            unreduced.mass_matrix.keys().enumerate().map(|(result, &index)| (index, result)).collect();
        // M is symmetric; only its upper triangle is computed.
        let block = |rows: &[ColumnId], columns: &[ColumnId]| -> Vec<(usize, usize, Expression)> {
            let mut block = Vec::new();
            for (j, &column) in columns.iter().enumerate() {
                for (i, &row) in rows.iter().enumerate() {
                    let result = entries.get(&(row.min(column), row.max(column)));
                    block.extend(result.map(|&result| (i, j, Expression::Result(result))));
                }
            }
            block
        };
        let derivation = &self.plan.derivation;
        let (unknowns, inputs) = (&derivation.unknowns, &derivation.inputs);
        let matrices = [
            body.matrix("Matrix", &block(unknowns, unknowns), u, u),
            body.matrix("Matrix", &block(unknowns, inputs), u, v),
            body.matrix("Matrix", &block(inputs, inputs), v, v),
        ];
        let force = |at: &ColumnId| Expression::Result(entries.len() + at.index());
        let forces =
            [&**unknowns, &**inputs].map(|indices| Expression::sized_vector(indices.iter().map(force).collect()));
        let members = ["unknowns", "mixed", "inputs", "unknown_forces", "input_forces"].map(str::to_owned);
        let members = members.into_iter().zip(matrices.into_iter().chain(forces));
        let value = Expression::structure(Type::Runtime("Unreduced", Vec::new()), members);
        let body = Body { value: Value::Plain(value), ..body };
        let doc = lines([
            "The mass matrix M and the forces F in all coordinates: `M q'' + Psi_q' lambda = F`.",
            "",
            "# Errors",
            "`PositionError::NotFinite` if an entry is not finite.",
        ]);
        self.add(self.signatures.unreduced(), doc, body);
    }
}
