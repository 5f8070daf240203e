//! Sensitivities to the parameters p at fixed inputs: Psi(u(p), p) = 0 gives J du/dp = -Psi_p.

use super::data::{Derivation, Quantity, Sensitivity};
use super::jacobian::{jacobian, places_of};
use super::linear::{Solutions, System};
use super::systems::minus_column;
use crate::graph::NodeId;
use crate::ids::{ParameterId, Table, UnknownId};
use crate::model::Mechanism;

/// The largest number of entries of du/dp for which formulas are printed; for more, only Psi_p is. The entries grow
/// with the square of the mechanism.
const MOST_FORMULAS: usize = 400;

impl Derivation {
    pub(super) fn derive_sensitivity(&mut self, mechanism: &Mechanism) {
        let mut names = Table::default();
        for parameter in &mechanism.parameters {
            let by = &parameter.name.field;
            let of = self.unknowns.iter().map(|&unknown| format!("{}_by_{by}", self.coordinates[unknown].name));
            names.push(of.map(|name| self.graph.symbol(name)).collect());
        }
        let indices = places_of(&mechanism.parameters, |p| p.symbol);
        let by_parameters = jacobian(&mut self.graph, &self.residual, &indices).into();
        for quantity in self.points.iter_mut().chain(&mut self.outputs) {
            quantity.by_parameters = jacobian(&mut self.graph, &quantity.value, &indices);
        }
        self.sensitivity = Some(Sensitivity { names, jacobian: by_parameters });
    }

    /// The systems J du/dp = -Psi_p.
    pub fn sensitivity_systems(&mut self) -> Table<ParameterId, System> {
        let Some(Sensitivity { names, jacobian, .. }) = self.sensitivity.clone() else { return Table::default() };
        let side = |parameter| minus_column(&mut self.graph, &jacobian, parameter);
        names.ids().map(side).zip(names).collect()
    }

    /// The formulas of du/dp, and du/dp for use in later formulas; empty if there are more than [`MOST_FORMULAS`].
    pub(super) fn sensitivity_formulas(
        &mut self,
    ) -> (Solutions<ParameterId, Option<NodeId>>, Solutions<ParameterId, NodeId>) {
        if self.sensitivity.as_ref().is_some_and(|first| first.names.len() * self.unknowns.len() > MOST_FORMULAS) {
            return (Table::default(), Table::default());
        }
        self.sensitivity_systems().iter().map(|system| self.solution_formulas(system)).unzip()
    }

    /// The total derivatives of a point or output by the parameters, l_p + l_u du/dp, for each component, with these
    /// values of du/dp.
    pub fn quantity_sensitivities(
        &mut self,
        quantity: &Quantity,
        solved: &Solutions<ParameterId, NodeId>,
    ) -> Table<ParameterId, Vec<NodeId>> {
        let zero = self.graph.zero();
        let (graph, unknowns) = (&mut self.graph, &self.unknowns);
        let of_parameter = |(index, solved): (ParameterId, &Table<UnknownId, NodeId>)| {
            let components = quantity.by_parameters.iter().zip(&quantity.jacobian);
            let total = components.map(|(direct, row)| {
                let direct = direct.get(&index).copied().unwrap_or(zero);
                Quantity::through_unknowns(graph, direct, row, unknowns, solved)
            });
            total.collect()
        };
        solved.enumerated().map(of_parameter).collect()
    }
}
