//! Equilibrium: Q(v) = 0 where nothing moves, and the stiffness -dQ/dv along the closures.
//!
//! Q is made of q and W, so that dQ/dv_k = Q_q w_k + sum `Q_W` L_k, with w_k the motion of all coordinates for a unit
//! rate of the input k and L the derivatives of the velocity ratios.

use rustc_hash::FxHashMap;

use super::scene::Scene;
use super::{Derivation, RatioDerivatives};
use crate::graph::{Function, NodeId, Number, SymbolId};

/// What is derived for the equilibrium of a scene, in terms of q, t, W and L.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Q at rest, by input.
    pub forces: Vec<NodeId>,
    /// The sum of the magnitudes of what each is made of.
    pub sizes: Vec<NodeId>,
    /// dQ/dv by rows.
    pub slopes: Vec<Vec<NodeId>>,
    /// The systems of W and L with the names of their solutions.
    pub systems: Vec<(Vec<NodeId>, Vec<SymbolId>)>,
}

impl Derivation {
    pub(super) fn derive_equilibrium(&mut self, scene: &Scene) -> Equilibrium {
        let zero = self.graph.zero();
        let rates = self.coordinates.iter().map(|coordinate| coordinate.rate).chain(scene.bias.iter().copied());
        let rest: FxHashMap<NodeId, NodeId> =
            rates.collect::<Vec<_>>().into_iter().map(|rate| (self.graph.variable(rate), zero)).collect();
        let forces = self.graph.replace(&scene.forces, &rest);
        let mut sizes = vec![Vec::new(); forces.len()];
        for (_, parts) in &scene.parts {
            for (at, part) in self.graph.replace(parts, &rest).into_iter().enumerate() {
                // Of each body there is one part a property and input.
                sizes[at % forces.len()].push((Number::ONE, self.graph.call(Function::Abs, &[part])));
            }
        }
        let sizes = sizes.into_iter().map(|terms| self.graph.sum(&terms)).collect();
        let motions: Vec<_> = (0..self.inputs.len()).map(|input| self.unit_motion(input)).collect();
        let second = self.second_order(&motions);
        let mut slopes = vec![Vec::new(); forces.len()];
        for (k, motion) in motions.into_iter().enumerate() {
            let mut seeds = motion;
            for (j, ratios) in self.ratios.iter().enumerate() {
                let names = &second.names[second.place(j, k)];
                seeds.extend(ratios.iter().zip(names).map(|(&ratio, &name)| (ratio, self.graph.variable(name))));
            }
            let column = self.graph.differentiate(&forces, &seeds);
            slopes.iter_mut().zip(column).for_each(|(row, slope): (&mut Vec<NodeId>, NodeId)| row.push(slope));
        }
        let ratios = self.ratios.clone().into_iter().enumerate();
        let mut systems: Vec<_> = ratios.map(|(input, names)| (self.ratio_side(input), names)).collect();
        let RatioDerivatives { names, terms, .. } = second;
        for (rows, names) in terms.into_iter().zip(names) {
            systems.push((rows.into_iter().map(|row| self.graph.negate(row)).collect(), names));
        }
        Equilibrium { forces, sizes, slopes, systems }
    }
}
