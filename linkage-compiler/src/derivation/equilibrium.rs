//! Static equilibrium: Q = 0 at rest, and the stiffness -dQ/dv along the motion of the mechanism.
//!
//! Q depends on q and W, so that dQ/dv_k = Q_q w_k + sum `Q_W` L_k, where w_k are the rates of all coordinates for a
//! unit rate of the input k, and L the derivatives of the velocity ratios.

use rustc_hash::FxHashMap;

use super::data::{Derivation, RatioDerivatives};
use super::linear::System;
use super::scene::{Equilibrium, Scene};
use crate::graph::{Function, NodeId, Number};
use crate::ids::Table;

impl Derivation {
    pub(super) fn derive_equilibrium(&mut self, scene: &Scene) -> Equilibrium {
        let zero = self.graph.zero();
        let rates = self.coordinates.iter().map(|coordinate| coordinate.rate).chain(scene.bias.iter().copied());
        let rest: FxHashMap<NodeId, NodeId> =
            rates.collect::<Vec<_>>().into_iter().map(|rate| (self.graph.variable(rate), zero)).collect();
        let forces = self.graph.replace(&scene.forces, &rest);
        let mut sizes = self.inputs.filled(Vec::new());
        for (_, parts) in &scene.parts {
            for (terms, part) in sizes.iter_mut().zip(self.graph.replace(parts, &rest)) {
                terms.push((Number::ONE, self.graph.call(Function::Abs, &[part])));
            }
        }
        let sizes = sizes.map(|terms| self.graph.sum(&terms));
        let motions: Table<_, _> = self.inputs.ids().map(|input| self.unit_motion(input)).collect();
        let second = self.second_order(&motions);
        let mut slopes = self.inputs.filled(Table::default());
        for (k, mut seeds) in motions.ids().zip(motions) {
            for (j, ratios) in self.ratios.enumerated() {
                let names = &second.names[second.indices[j][k]];
                seeds.extend(ratios.iter().zip(names).map(|(&ratio, &name)| (ratio, self.graph.variable(name))));
            }
            let column = self.graph.differentiate(&forces, &seeds);
            for (row, slope) in slopes.iter_mut().zip(column) {
                row.push(slope);
            }
        }
        let mut systems: Vec<System> = self.ratio_systems().into_iter().collect();
        let RatioDerivatives { names, terms, .. } = second;
        for (rows, names) in terms.into_iter().zip(names) {
            systems.push((rows.map(|row| self.graph.negate(row)), names));
        }
        Equilibrium { forces: forces.into(), sizes, slopes, systems }
    }
}
