//! The forces in joints: the generalised forces of the displacements that open them.
//!
//! With a displacement d of a link from a joint (`model::Opened`) as one more coordinate, its row of
//! `M q'' + Psi' lambda = F` holds the force R in the joint on the link:
//! `R = sum m (s'' - g) s_d + Psi_d' lambda - sum F s_d` at d = 0, with the forces F of effects and contacts along their scalars s.

use rustc_hash::FxHashMap;

use super::data::Derivation;
use super::scene::{BearingRow, Multipliers, Reactions};
use crate::graph::{Graph, NodeId, Number, SymbolId};
use crate::ids::SceneId;
use crate::model::{self, LoadKind, Mechanism};

impl Derivation {
    pub(super) fn derive_reactions(
        &mut self,
        mechanism: &Mechanism,
        place: SceneId,
        scene: &model::Scene,
    ) -> Reactions {
        let contact_forces = self.contact_forces(scene);
        let multipliers = self.derive_multipliers(mechanism, scene, &contact_forces);
        let opened = &mechanism.opened;
        let mut forces = Vec::new();
        for &load in &scene.opened() {
            forces.push(opened.loads[load].displacement.map(|displacement| {
                let mut terms = Vec::new();
                for (index, body) in mechanism.bodies.enumerated() {
                    let displaced = &opened.bodies[index];
                    for part in self.moving_parts(index, body, scene) {
                        let moved = match part.property {
                            "mass" => displaced.center.map(Vec::from),
                            _ => displaced.angle.map(|angle| vec![angle]),
                        };
                        let scalars = part.scalars.iter().zip(&part.fields);
                        for ((&scalar, &field), moved) in scalars.zip(moved.unwrap_or_default()) {
                            let slope = self.by_displacement(moved, displacement, mechanism);
                            if self.graph.is_zero(slope) {
                                continue;
                            }
                            let zero = self.graph.zero();
                            let acceleration = if part.is_inert { self.acceleration_of(scalar) } else { zero };
                            let net = self.graph.subtract(acceleration, field);
                            terms.push((Number::ONE, self.graph.product(&[(part.factor, 1), (net, 1), (slope, 1)])));
                        }
                    }
                }
                let lambda = multipliers.names.iter().map(|&name| self.graph.variable(name)).collect::<Vec<_>>();
                let rows = opened.rows.iter().copied().zip(lambda).map(|(row, lambda)| (Number::ONE, row, lambda));
                let paths = &opened.scenes[place];
                let laws = paths.laws.iter().zip(&scene.laws).map(|(&path, law)| (Number::MINUS_ONE, path, law.law));
                let forces = contact_forces.iter().map(|&symbol| self.graph.variable(symbol)).collect::<Vec<_>>();
                let contacts = paths.contacts.iter().zip(forces).map(|(&path, force)| (Number::MINUS_ONE, path, force));
                for (sign, path, force) in rows.chain(laws).chain(contacts).collect::<Vec<_>>() {
                    let slope = self.by_displacement(path, displacement, mechanism);
                    terms.push((sign, self.graph.multiply(force, slope)));
                }
                let sum = self.graph.sum(&terms);
                self.simplest(sum)
            }));
        }
        let opened = scene.opened();
        let mut bearings = Vec::new();
        for contact in &scene.contacts {
            let place = contact.bearing.and_then(|load| opened.iter().position(|&other| other == load));
            bearings.push(place.map(|place| {
                let is_guide = matches!(mechanism.opened.loads[opened[place]].kind, LoadKind::Guide { .. });
                let [first, second] = forces[place];
                // The moment of a guide is no force.
                let second = if is_guide { self.graph.zero() } else { second };
                [first, second].map(|force| self.bearing_row(force, &multipliers, &contact_forces))
            }));
        }
        Reactions { opened, contact_forces, multipliers, forces, bearings }
    }

    /// The parts of a component of a reaction.
    fn bearing_row(&mut self, force: NodeId, multipliers: &Multipliers, contacts: &[SymbolId]) -> BearingRow {
        let force = self.in_solved(force, multipliers);
        let slopes = |graph: &mut Graph, symbols: &[SymbolId]| -> Vec<NodeId> {
            symbols.iter().map(|&symbol| graph.partial(&[force], symbol)[0]).collect()
        };
        let accelerations: Vec<SymbolId> = self.coordinates.iter().map(|c| c.acceleration).collect();
        let by_accelerations = slopes(&mut self.graph, &accelerations);
        let by_multipliers = slopes(&mut self.graph, &multipliers.solved);
        let by_contacts = slopes(&mut self.graph, contacts);
        let zero = self.graph.zero();
        let all = accelerations.iter().chain(&multipliers.solved).chain(contacts);
        let none: FxHashMap<NodeId, NodeId> = all.map(|&symbol| (self.graph.variable(symbol), zero)).collect();
        let constant = self.graph.replace(&[force], &none)[0];
        let is_nonzero = |graph: &Graph, node: NodeId| !graph.is_zero(node);
        let accelerations = self.coordinates.ids().zip(by_accelerations);
        let rows = multipliers.solved.ids().zip(by_multipliers);
        BearingRow {
            constant,
            accelerations: accelerations.filter(|(_, node)| is_nonzero(&self.graph, *node)).collect(),
            multipliers: rows.filter(|(_, node)| is_nonzero(&self.graph, *node)).collect(),
            contacts: by_contacts,
        }
    }

    /// The symbols of the forces of frictions and stops along their scalars.
    fn contact_forces(&mut self, scene: &model::Scene) -> Vec<SymbolId> {
        let of = |label: &str| {
            let words = label.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
            words.collect::<Vec<_>>().join("_").to_lowercase()
        };
        let names = scene.contacts.iter().map(|contact| format!("force_of_{}", of(&contact.label)));
        names.map(|name| self.graph.symbol(name)).collect()
    }

    /// The derivative of an expression with displaced joints by one displacement, where all are zero.
    fn by_displacement(&mut self, node: NodeId, displacement: SymbolId, mechanism: &Mechanism) -> NodeId {
        if !self.graph.symbols_of(&[node]).contains(&displacement) {
            return self.graph.zero();
        }
        let slope = self.graph.partial(&[node], displacement)[0];
        let zero = self.graph.zero();
        let all = mechanism.opened.loads.iter().flat_map(|load| load.displacement);
        let closed: FxHashMap<NodeId, NodeId> = all.map(|symbol| (self.graph.variable(symbol), zero)).collect();
        self.graph.replace(&[slope], &closed)[0]
    }
}
