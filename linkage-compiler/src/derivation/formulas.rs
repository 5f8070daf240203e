//! Formulas for documentation: W, det J and J^-1 in simplified form, and the conditions that they assume. Kernels
//! compute the same values with names and common subexpressions.

use std::collections::BTreeSet;

use super::data::{Derivation, Quantity};
use super::linear::{Row, Solutions};
use crate::algebra::adjugate;
use crate::graph::{Condition, NodeId};
use crate::ids::{GroupId, InputId, MemberId, PairId, ParameterId, Table};

/// 1 / det J of a group, and adj J by rows.
pub type Inverse = (NodeId, Table<MemberId, Row<MemberId>>);

/// Formulas for documentation only.
#[derive(Debug, Clone)]
pub struct Formulas {
    /// W; `None` in groups that are solved by factorisation.
    pub ratios: Solutions<InputId, Option<NodeId>>,
    /// L; empty without a `derive` statement, like `sensitivities`.
    pub ratio_derivatives: Solutions<PairId, Option<NodeId>>,
    /// du/dp.
    pub sensitivities: Solutions<ParameterId, Option<NodeId>>,
    /// det J.
    pub determinant: Option<NodeId>,
    pub inverses: Table<GroupId, Option<Inverse>>,
    pub points: Vec<QuantityFormulas>,
    pub outputs: Vec<QuantityFormulas>,
    /// The conditions that the formulas assume.
    pub conditions: BTreeSet<Condition>,
}

/// The derivatives of a point or output, for each component, in terms of W, L and du/dp.
#[derive(Debug, Clone)]
pub struct QuantityFormulas {
    /// W_l.
    pub ratios: Table<InputId, Vec<NodeId>>,
    /// L_l.
    pub ratio_derivatives: Table<PairId, Vec<NodeId>>,
    /// dl/dp.
    pub sensitivities: Table<ParameterId, Vec<NodeId>>,
}

impl Formulas {
    /// Makes the formulas of a derivation.
    pub fn new(derivation: &mut Derivation) -> Self {
        let ratios = derivation.ratio_formulas();
        let (ratio_derivatives, second) = derivation.ratio_derivative_formulas();
        let (sensitivities, by_parameters) = derivation.sensitivity_formulas();
        let determinant = derivation.determinant();
        let mut inverses = Table::default();
        for group in derivation.groups.clone() {
            let matrix = derivation.block_matrix(&group);
            inverses.push(match (group.determinant, matrix.as_slice()) {
                (Some(determinant), [first, second]) => {
                    let graph = &mut derivation.graph;
                    let rows = adjugate(graph, [[first[0], first[1]], [second[0], second[1]]]);
                    let rows = rows.map(|row| {
                        let row: Table<MemberId, NodeId> = row.into_iter().collect();
                        row.ids().zip(row).filter(|(_, entry)| !graph.is_zero(*entry)).collect()
                    });
                    Some((graph.power(determinant.value, -1), rows.into_iter().collect()))
                }
                _ => None,
            });
        }
        let (points, outputs) = (derivation.points.clone(), derivation.outputs.clone());
        let mut of = |quantity: Quantity| QuantityFormulas {
            ratios: quantity_ratios(derivation, &quantity),
            ratio_derivatives: derivation.quantity_ratio_derivatives(&quantity, &second),
            sensitivities: derivation.quantity_sensitivities(&quantity, &by_parameters),
        };
        let points = points.into_iter().map(&mut of).collect();
        let outputs = outputs.into_iter().map(of).collect();
        let conditions = derivation.graph.take_conditions();
        Self { ratios, ratio_derivatives, sensitivities, determinant, inverses, points, outputs, conditions }
    }
}

/// W_l for each component.
fn quantity_ratios(derivation: &mut Derivation, quantity: &Quantity) -> Table<InputId, Vec<NodeId>> {
    let inputs = derivation.inputs.ids();
    inputs.map(|input| quantity.jacobian.iter().map(|row| derivation.quantity_ratio(row, input)).collect()).collect()
}
