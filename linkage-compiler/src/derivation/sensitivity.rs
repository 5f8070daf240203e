//! Sensitivities to the parameters p at fixed inputs: Psi(u(p), p) = 0 gives J du/dp = -Psi_p.

use super::{Derivation, Places, Quantity, Row, jacobian};
use crate::graph::{NodeId, SymbolId};
use crate::model::Mechanism;

/// Of a larger du/dp the reader is told Psi_p alone: it grows with the square of the mechanism, and nobody reads
/// so many formulas.
const MOST_FORMULAS: usize = 400;

/// What is derived for the sensitivities.
#[derive(Debug, Clone)]
pub struct Sensitivity {
    /// The names of du/dp: by parameter, and then by unknown.
    pub names: Vec<Vec<SymbolId>>,
    /// Psi_p, by the place of the parameter.
    pub jacobian: Vec<Row>,
}

impl Derivation {
    pub(super) fn derive_sensitivity(&mut self, mechanism: &Mechanism) {
        let mut names = Vec::new();
        for parameter in &mechanism.parameters {
            let by = &parameter.name.field;
            let of = self.unknowns.iter().map(|&unknown| format!("{}_by_{by}", self.coordinates[unknown].name));
            names.push(of.map(|name| self.graph.symbol(name)).collect());
        }
        let places: Places = mechanism.parameters.iter().enumerate().map(|(place, p)| (p.symbol, place)).collect();
        let by_parameters = jacobian(&mut self.graph, &self.residual, &places);
        for quantity in self.points.iter_mut().chain(&mut self.outputs) {
            quantity.by_parameters = jacobian(&mut self.graph, &quantity.value, &places);
        }
        self.sensitivity = Some(Sensitivity { names, jacobian: by_parameters });
    }

    /// The right sides of J du/dp = -Psi_p with the names of the solutions, one a parameter.
    pub fn sensitivity_systems(&mut self) -> Vec<(Vec<NodeId>, Vec<SymbolId>)> {
        let Some(Sensitivity { names, jacobian, .. }) = self.sensitivity.clone() else { return Vec::new() };
        let zero = self.graph.zero();
        let mut systems = Vec::new();
        for (place, names) in names.into_iter().enumerate() {
            let entries = jacobian.iter().map(|row| row.get(&place).copied().unwrap_or(zero));
            systems.push((entries.map(|entry| self.graph.negate(entry)).collect(), names));
        }
        systems
    }

    /// du/dp by parameter and unknown, as formulas, and as later formulas refer to them; nothing where they are
    /// too many to be read.
    pub(super) fn sensitivity_formulas(&mut self) -> (Vec<Vec<Option<NodeId>>>, Vec<Vec<NodeId>>) {
        if self.sensitivity.as_ref().is_some_and(|first| first.names.len() * self.unknowns.len() > MOST_FORMULAS) {
            return (Vec::new(), Vec::new());
        }
        self.sensitivity_systems().iter().map(|(side, names)| self.solution_formulas(side, names)).unzip()
    }

    /// The total derivatives of a point or output by the parameters, by parameter and component, with du/dp by
    /// these values: l_p + l_u du/dp.
    pub fn quantity_sensitivities(&mut self, quantity: &Quantity, solved: &[Vec<NodeId>]) -> Vec<Vec<NodeId>> {
        let zero = self.graph.zero();
        let (graph, unknowns) = (&mut self.graph, &self.unknowns);
        let of_parameter = |(place, solved): (usize, &Vec<NodeId>)| {
            let components = quantity.by_parameters.iter().zip(&quantity.jacobian);
            let total = components.map(|(direct, row)| {
                let direct = direct.get(&place).copied().unwrap_or(zero);
                Quantity::through_unknowns(graph, direct, row, unknowns, solved)
            });
            total.collect()
        };
        solved.iter().enumerate().map(of_parameter).collect()
    }
}
