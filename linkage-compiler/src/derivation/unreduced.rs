//! M and F of `M q'' + Psi_q' lambda = F` in all coordinates, which can be reduced to any choice of independent ones.
//!
//! A scalar s has the rate `s' = s_q q'` and the acceleration `s'' = s_q q'' + s_0`, where `s_0` is quadratic in `q'`.
//! Virtual work gives M = sum m `s_q'` `s_q` and F = sum F `s_q'` - m `s_q'` (`s_0` - g).

use std::collections::BTreeMap;

use super::data::Derivation;
use super::jacobian::along_rates;
use super::scene::Unreduced;
use crate::graph::{NodeId, Number};
use crate::ids::ColumnId;
use crate::model::{self, Mechanism};

impl Derivation {
    pub(super) fn derive_unreduced(&mut self, mechanism: &Mechanism, scene: &model::Scene) -> Unreduced {
        let mut entries: BTreeMap<(ColumnId, ColumnId), Vec<(Number, NodeId)>> = BTreeMap::new();
        let mut forces = self.coordinates.filled(Vec::new());
        for (index, body) in mechanism.bodies.enumerated() {
            for part in self.moving_parts(index, body, scene) {
                for (&scalar, &field) in part.scalars.iter().zip(&part.fields) {
                    let row = self.row_of(scalar);
                    let bias = if part.is_inert { self.quadratic_part(scalar) } else { self.graph.zero() };
                    let difference = self.graph.subtract(bias, field);
                    let force = self.graph.multiply(part.factor, difference);
                    for (&place, &entry) in &row {
                        forces[place].push((Number::MINUS_ONE, self.graph.multiply(entry, force)));
                        for (&other, &factor) in row.range(place..).filter(|_| part.is_inert) {
                            let product = self.graph.multiply(entry, factor);
                            let term = self.graph.multiply(part.factor, product);
                            entries.entry((place, other)).or_default().push((Number::ONE, term));
                        }
                    }
                }
            }
        }
        for law in &scene.laws {
            for (place, entry) in self.row_of(law.along) {
                forces[place].push((Number::ONE, self.graph.multiply(law.law, entry)));
            }
        }
        let mass_matrix = entries.into_iter().map(|(place, terms)| (place, self.simplest_sum(&terms)));
        let mass_matrix = mass_matrix.collect::<Vec<_>>().into_iter();
        let mass_matrix = mass_matrix.filter(|(_, entry)| !self.graph.is_zero(*entry)).collect();
        let forces = forces.iter().map(|terms| self.graph.sum(terms)).collect();
        Unreduced { mass_matrix, forces }
    }

    /// `s_0`: `s''` in terms of q and `q'` at `q'' = 0`.
    fn quadratic_part(&mut self, scalar: NodeId) -> NodeId {
        let seeds = along_rates(&mut self.graph, &self.coordinates);
        let rate = self.graph.differentiate(&[scalar], &seeds)[0];
        self.graph.differentiate(&[rate], &seeds)[0]
    }

    fn simplest_sum(&mut self, terms: &[(Number, NodeId)]) -> NodeId {
        let sum = self.graph.sum(terms);
        self.simplest(sum)
    }
}
