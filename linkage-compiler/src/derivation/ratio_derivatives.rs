//! The derivatives L_jk = d2u / dv_j dv_k of the velocity ratios: "velocity coefficients and their
//! derivatives" (S. Doughty, "Mechanics of Machines", 1988), of any number of inputs.
//!
//! Along w_j = (W_j, e_j), the motion of all coordinates for a unit rate of the input j, the closures
//! stay closed: Psi_q w_j = 0. Once more, along w_k: J L_jk = -(Psi_q w_j)_q w_k. The right side is gamma as
//! the bilinear form of two motions, so that L_jk = L_kj.

use std::collections::BTreeMap;

use super::{Derivation, Quantity};
use crate::graph::{Graph, NodeId, SymbolId};

/// What is derived for the derivatives of the velocity ratios.
#[derive(Debug, Clone)]
pub struct RatioDerivatives {
    /// The inputs j <= k, each pair once.
    pub pairs: Vec<(usize, usize)>,
    /// What stands behind the name of what is derived, by pair.
    pub endings: Vec<String>,
    /// The names of L: by pair, and then by unknown.
    pub names: Vec<Vec<SymbolId>>,
    /// (Psi_q w_j)_q w_k, by pair and row, in terms of W.
    pub terms: Vec<Vec<NodeId>>,
}

impl RatioDerivatives {
    /// The place of a pair in either order.
    #[must_use]
    pub fn place(&self, j: usize, k: usize) -> usize {
        let pair = (j.min(k), j.max(k));
        self.pairs.iter().position(|&other| other == pair).unwrap_or(0)
    }
}

impl Derivation {
    pub(super) fn derive_ratio_derivatives(&mut self) {
        let motions: Vec<_> = (0..self.inputs.len()).map(|input| self.unit_motion(input)).collect();
        self.ratio_derivatives = Some(self.second_order(&motions));
        for quantity in self.points.iter_mut().chain(&mut self.outputs) {
            quantity.along_inputs = second_derivatives(&mut self.graph, &quantity.value, &motions);
        }
    }

    /// L by new names, along the unit motions of the inputs.
    pub(super) fn second_order(&mut self, motions: &[BTreeMap<SymbolId, NodeId>]) -> RatioDerivatives {
        let count = self.inputs.len();
        let pairs: Vec<(usize, usize)> = (0..count).flat_map(|j| (j..count).map(move |k| (j, k))).collect();
        let by = |input: usize| self.coordinates[self.inputs[input]].name.as_str();
        let ending = |&(j, k): &(usize, usize)| match count {
            1 => "ratio_derivative".to_owned(),
            _ => format!("by_{}_by_{}", by(j), by(k)),
        };
        let endings: Vec<String> = pairs.iter().map(ending).collect();
        let mut names = Vec::new();
        for ending in &endings {
            let of = self.unknowns.iter().map(|&unknown| &self.coordinates[unknown].name);
            names.push(of.map(|of| self.graph.symbol(format!("{of}_{ending}"))).collect());
        }
        let terms = second_derivatives(&mut self.graph, &self.residual, motions);
        RatioDerivatives { pairs, endings, names, terms }
    }

    /// w_j = (W_j, e_j).
    pub(super) fn unit_motion(&mut self, input: usize) -> BTreeMap<SymbolId, NodeId> {
        let mut motion = BTreeMap::from([(self.coordinates[self.inputs[input]].value, self.graph.one())]);
        for (&unknown, &ratio) in self.unknowns.iter().zip(&self.ratios[input]) {
            motion.insert(self.coordinates[unknown].value, self.graph.variable(ratio));
        }
        motion
    }

    /// L by pair and unknown, as formulas in terms of W, and as later formulas refer to them.
    pub(super) fn ratio_derivative_formulas(&mut self) -> (Vec<Vec<Option<NodeId>>>, Vec<Vec<NodeId>>) {
        let second = self.ratio_derivative_systems().split_off(self.ratios.len());
        second.iter().map(|(side, names)| self.solution_formulas(side, names)).unzip()
    }

    /// The right sides of J W_j = -A e_j and J L_jk = -(Psi_q w_j)_q w_k with the names of the solutions.
    pub fn ratio_derivative_systems(&mut self) -> Vec<(Vec<NodeId>, Vec<SymbolId>)> {
        let ratios = self.ratios.clone().into_iter().enumerate();
        let mut systems: Vec<_> = ratios.map(|(input, ratios)| (self.ratio_side(input), ratios)).collect();
        if let Some(RatioDerivatives { names, terms, .. }) = self.ratio_derivatives.clone() {
            let sides = terms.into_iter().map(|rows| rows.into_iter().map(|row| self.graph.negate(row)).collect());
            let sides: Vec<Vec<NodeId>> = sides.collect();
            systems.extend(sides.into_iter().zip(names));
        }
        systems
    }

    /// The second derivatives of a point or output by the inputs, by pair and component, with L by these
    /// values: (l_q w_j)_q w_k + l_u L_jk.
    pub fn quantity_ratio_derivatives(&mut self, quantity: &Quantity, solved: &[Vec<NodeId>]) -> Vec<Vec<NodeId>> {
        let (graph, unknowns) = (&mut self.graph, &self.unknowns);
        let of_pair = |(direct, solved): (&Vec<NodeId>, &Vec<NodeId>)| {
            let components = direct.iter().zip(&quantity.jacobian);
            let total =
                components.map(|(&direct, row)| Quantity::through_unknowns(graph, direct, row, unknowns, solved));
            total.collect()
        };
        quantity.along_inputs.iter().zip(solved).map(of_pair).collect()
    }
}

/// (f_q w_j)_q w_k, for the pairs j <= k in order.
fn second_derivatives(graph: &mut Graph, of: &[NodeId], motions: &[BTreeMap<SymbolId, NodeId>]) -> Vec<Vec<NodeId>> {
    let mut all = Vec::new();
    for (j, first) in motions.iter().enumerate() {
        let along = graph.differentiate(of, first);
        all.extend(motions[j..].iter().map(|second| graph.differentiate(&along, second)));
    }
    all
}
