//! What is derived for the reader: W, det J and J^-1 as a mechanic writes them, and what they take for
//! granted. The kernels compute the same numbers by names and shared parts.

use std::collections::BTreeSet;

use super::{Derivation, Quantity, Row};
use crate::graph::{Condition, NodeId};
use crate::simplify::adjugate;

/// 1 / det J of a block, and adj J by rows.
pub type Inverse = (NodeId, Vec<Row>);

/// What is derived for the reader alone.
#[derive(Debug, Clone)]
pub struct Formulas {
    /// W, by input and unknown; none where a block is solved by factorisation.
    pub ratios: Vec<Vec<Option<NodeId>>>,
    /// det J.
    pub determinant: Option<NodeId>,
    /// By block.
    pub inverses: Vec<Option<Inverse>>,
    /// W_l, by quantity, input and component.
    pub points: Vec<Vec<Vec<NodeId>>>,
    pub outputs: Vec<Vec<Vec<NodeId>>>,
    /// What the formulas take for granted.
    pub conditions: BTreeSet<Condition>,
}

impl Formulas {
    /// Derives them from a derivation.
    pub fn new(derivation: &mut Derivation) -> Self {
        let ratios = derivation.ratio_formulas();
        let determinant = derivation.determinant();
        let mut inverses = Vec::new();
        for block in derivation.blocks.clone() {
            let matrix = derivation.block_matrix(&block);
            inverses.push(match (block.determinant, matrix.as_slice()) {
                (Some(determinant), [first, second]) => {
                    let graph = &mut derivation.graph;
                    let rows = adjugate(graph, [[first[0], first[1]], [second[0], second[1]]]);
                    let rows =
                        rows.map(|row| row.into_iter().enumerate().filter(|(_, e)| !graph.is_zero(*e)).collect());
                    Some((graph.power(determinant.value, -1), rows.to_vec()))
                }
                _ => None,
            });
        }
        let (points, outputs) = (derivation.points.clone(), derivation.outputs.clone());
        let points = quantity_ratios(derivation, &points);
        let outputs = quantity_ratios(derivation, &outputs);
        let conditions = derivation.graph.take_conditions();
        Self { ratios, determinant, inverses, points, outputs, conditions }
    }
}

/// W_l by quantity, input and component.
fn quantity_ratios(derivation: &mut Derivation, quantities: &[Quantity]) -> Vec<Vec<Vec<NodeId>>> {
    let mut all = Vec::new();
    for quantity in quantities {
        let mut of_quantity = Vec::new();
        for input in 0..derivation.inputs.len() {
            of_quantity.push(quantity.jacobian.iter().map(|row| derivation.quantity_ratio(row, input)).collect());
        }
        all.push(of_quantity);
    }
    all
}
