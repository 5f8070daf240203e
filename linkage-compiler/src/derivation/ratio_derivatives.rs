//! The derivatives L_jk = d2u / dv_j dv_k of the velocity ratios: "velocity coefficients and their
//! derivatives" (S. Doughty, "Mechanics of Machines", 1988), for any number of inputs.
//!
//! Let w_j = (W_j, e_j) be the rates of all coordinates for a unit rate of the input j: Psi_q w_j = 0. The derivative
//! of this along w_k gives J L_jk = -(Psi_q w_j)_q w_k. The right side is gamma as a symmetric bilinear form, so that
//! L_jk = L_kj.

use std::collections::BTreeMap;

use super::data::{Derivation, Quantity, RatioDerivatives};
use super::linear::{Solutions, System};
use crate::graph::{Graph, NodeId, SymbolId};
use crate::ids::{InputId, PairId, Table, UnknownId};

impl Derivation {
    pub(super) fn derive_ratio_derivatives(&mut self) {
        let motions: Table<_, _> = self.inputs.ids().map(|input| self.unit_motion(input)).collect();
        self.ratio_derivatives = Some(self.second_order(&motions));
        for quantity in self.points.iter_mut().chain(&mut self.outputs) {
            quantity.along_inputs = second_derivatives(&mut self.graph, &quantity.value, &motions).into();
        }
    }

    /// New symbols for L, and the right sides of its systems.
    pub(super) fn second_order(&mut self, motions: &Table<InputId, BTreeMap<SymbolId, NodeId>>) -> RatioDerivatives {
        let (mut pairs, mut indices) = (Table::default(), Table::<InputId, Table<InputId, PairId>>::default());
        for j in self.inputs.ids() {
            let index = |k| if k < j { indices[k][j] } else { pairs.push((j, k)) };
            let of_input = self.inputs.ids().map(index).collect();
            indices.push(of_input);
        }
        let by = |input: InputId| self.coordinates[self.inputs[input]].name.as_str();
        let ending = |&(j, k): &(InputId, InputId)| match self.inputs.len() {
            1 => "ratio_derivative".to_owned(),
            _ => format!("by_{}_by_{}", by(j), by(k)),
        };
        let endings: Table<PairId, String> = pairs.iter().map(ending).collect();
        let mut names = Table::default();
        for ending in &endings {
            let of = self.unknowns.iter().map(|&unknown| &self.coordinates[unknown].name);
            names.push(of.map(|of| self.graph.symbol(format!("{of}_{ending}"))).collect());
        }
        let terms = second_derivatives(&mut self.graph, &self.residual, motions);
        let terms = terms.into_iter().map(Table::from).collect();
        RatioDerivatives { pairs, indices, endings, names, terms }
    }

    /// w_j = (W_j, e_j), by coordinate symbol.
    pub(super) fn unit_motion(&mut self, input: InputId) -> BTreeMap<SymbolId, NodeId> {
        let mut motion = BTreeMap::from([(self.coordinates[self.inputs[input]].value, self.graph.one())]);
        for (&unknown, &ratio) in self.unknowns.iter().zip(&self.ratios[input]) {
            motion.insert(self.coordinates[unknown].value, self.graph.variable(ratio));
        }
        motion
    }

    /// The formulas of L in terms of W, and L for use in later formulas.
    pub(super) fn ratio_derivative_formulas(
        &mut self,
    ) -> (Solutions<PairId, Option<NodeId>>, Solutions<PairId, NodeId>) {
        let second = self.ratio_derivative_systems().split_off(self.ratios.len());
        second.iter().map(|system| self.solution_formulas(system)).unzip()
    }

    /// The systems J W_j = -A e_j and J L_jk = -(Psi_q w_j)_q w_k.
    pub fn ratio_derivative_systems(&mut self) -> Vec<System> {
        let mut systems: Vec<System> = self.ratio_systems().into_iter().collect();
        if let Some(RatioDerivatives { names, terms, .. }) = self.ratio_derivatives.clone() {
            let sides = terms.map(|rows| rows.map(|row| self.graph.negate(row)));
            systems.extend(sides.into_iter().zip(names));
        }
        systems
    }

    /// The second derivatives of a point or output by the inputs, (l_q w_j)_q w_k + l_u L_jk, for each component, with
    /// these values of L.
    pub fn quantity_ratio_derivatives(
        &mut self,
        quantity: &Quantity,
        solved: &Solutions<PairId, NodeId>,
    ) -> Table<PairId, Vec<NodeId>> {
        let (graph, unknowns) = (&mut self.graph, &self.unknowns);
        let of_pair = |(direct, solved): (&Vec<NodeId>, &Table<UnknownId, NodeId>)| {
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
