//! Equations of motion reduced to the independent coordinates by the velocity ratios.
//!
//! With u' = W v' a scalar s of q has the rate s' = `s_j` v'j, `s_j` = ds/du W_j + ds/dvj, and the acceleration
//! `s'' = s_j v''j + s_0`, where the bias `s_0` is `s''` at `v'' = 0`. With the centres G and angular velocities w of the
//! bodies, virtual work gives `M v'' = Q` with M = sum m (`G_j` . `G_k`) + j `w_j` `w_k` and
//! Q = sum F `s_j` - m `G_j` . (`G_0` - g) - j `w_j` `w_0`. For one input `M v'' + (dM/dv) v'^2 / 2 = F s_1` is
//! Eksergian's equation (P. Eksergian, "Dynamical analysis of machines", Journal of the Franklin Institute, 1930/31).

use std::collections::{BTreeMap, BTreeSet};

use super::angles::angles;
use super::data::Derivation;
use super::jacobian::{along_rates, jacobian, places_of};
use super::linear::Row;
use super::scene::{Contact, ContactFormula, Prescribed, Scene};
use crate::algebra::{gather, simplify};
use crate::graph::{Function, Node, NodeId, Number, SymbolId};
use crate::ids::{BodyId, ColumnId, InputId, RowId, SceneId, Table, UnknownId};
use crate::model::{self, Account, Driver, Mechanism, SceneRequest};

/// The mass of a body with the coordinates x and y of its centre, or its moment of inertia with its angle.
pub(super) struct MovingPart {
    /// "mass" or "inertia", for error messages.
    pub property: &'static str,
    /// The mass or the moment of inertia.
    pub factor: NodeId,
    /// The coordinates of the centre, or the angle.
    pub scalars: Vec<NodeId>,
    /// The gravitational acceleration along each scalar.
    pub fields: Vec<NodeId>,
    /// True if it has inertia, false if it has weight only.
    pub is_inert: bool,
}

/// The motion of a scalar s.
struct ScalarMotion {
    /// The velocity ratio `s_j` for each input.
    ratios: Table<InputId, NodeId>,
    /// s'.
    rate: NodeId,
}

impl Derivation {
    pub(super) fn derive_scenes(&mut self, mechanism: &Mechanism, driver: &Driver) {
        let own = |scene: &model::Scene| mechanism.drivers[scene.driver].name == driver.name;
        for (id, scene) in mechanism.scenes.enumerated().filter(|(_, scene)| own(scene)) {
            let mut derived = self.derive_scene(mechanism, id, scene);
            derived.kinks = self.derive_kinks(mechanism, driver, scene);
            derived.equilibrium =
                scene.requests.contains(&SceneRequest::Equilibrium).then(|| self.derive_equilibrium(&derived));
            self.scenes.push(derived);
        }
        // Last, so that their nodes change the order of terms of nothing else.
        for mut scene in std::mem::take(&mut self.scenes) {
            if mechanism.scenes[scene.id].inertia.is_some() {
                scene.gap_changes = self.derive_gap_changes(&scene);
            }
            self.scenes.push(scene);
        }
    }

    fn derive_scene(&mut self, mechanism: &Mechanism, id: SceneId, scene: &model::Scene) -> Scene {
        let bias = self.bias_symbols();
        let motion = self.motion_symbols(&bias);
        let zero = self.graph.zero();
        let mut mass_matrix = self.inputs.filled(self.inputs.filled(Vec::new()));
        let mut forces = self.inputs.filled(Vec::new());
        let (mut kinetic, mut potential) = (Vec::new(), Vec::new());
        let (mut effects, mut masses) = (Vec::new(), Vec::new());
        for (index, body) in mechanism.bodies.enumerated() {
            let parts = self.moving_parts(index, body, scene);
            let is_moved = !parts.is_empty();
            let mut added = self.inputs.filled(Vec::new());
            for MovingPart { property, factor, scalars, fields, is_inert } in parts {
                masses.push((format!("the {property} of {}", body.name.text), factor));
                let moved: Vec<ScalarMotion> = scalars.iter().map(|&scalar| self.motion_of(scalar, &motion)).collect();
                let mut biases = vec![zero; moved.len()];
                if is_inert {
                    for (bias_of, along) in biases.iter_mut().zip(&moved) {
                        let direct = self.bias_of(along.rate, &bias);
                        *bias_of = gather(&mut self.graph, direct, &motion);
                    }
                }
                for (row, forces) in self.inputs.ids().zip(forces.iter_mut()) {
                    let mut is_one_term = false;
                    if is_inert {
                        for (column, entry) in self.inputs.ids().zip(mass_matrix[row].iter_mut()) {
                            let pairs = moved.iter().map(|s| (s.ratios[row], s.ratios[column]));
                            let sum = self.scalar_product(pairs.collect());
                            entry.push((Number::ONE, self.graph.multiply(factor, sum)));
                            is_one_term |= row == column && self.is_one_term(sum);
                        }
                    }
                    let ratios = moved.iter().map(|along| along.ratios[row]);
                    let mut sums = Vec::new();
                    if is_one_term {
                        sums.push(self.scalar_product(ratios.clone().zip(biases.iter().copied()).collect()));
                    }
                    if sums.first().is_some_and(|&inert| self.is_one_term(inert)) {
                        // For a rotation about a fixed point the inertia term is one product, which is shared with the
                        // moment of inertia; keep it apart from the weight.
                        let weight = self.scalar_product(ratios.zip(fields.iter().copied()).collect());
                        sums.push(self.graph.negate(weight));
                    } else {
                        let net = biases.iter().zip(&fields).map(|(&bias, &field)| self.graph.subtract(bias, field));
                        let net: Vec<NodeId> = net.collect();
                        sums = vec![self.scalar_product(ratios.zip(net).collect())];
                    }
                    for sum in sums {
                        let force = self.graph.multiply(factor, sum);
                        added[row].push((Number::MINUS_ONE, force));
                        forces.push((Number::MINUS_ONE, force));
                    }
                }
                if is_inert {
                    let sum = self.scalar_product(moved.iter().map(|s| (s.rate, s.rate)).collect());
                    kinetic.push((Number::ratio(1, 2), self.graph.multiply(factor, sum)));
                }
                let weight = self.scalar_product(scalars.into_iter().zip(fields).collect());
                potential.push((Number::MINUS_ONE, self.graph.multiply(factor, weight)));
            }
            if is_moved {
                let gathered = |terms: &Vec<(Number, NodeId)>| {
                    let sum = self.graph.sum(terms);
                    gather(&mut self.graph, sum, &motion)
                };
                let added = added.iter().map(gathered).collect();
                effects.push((format!("body {}", body.name.text), added));
            }
        }
        let (mut applied, mut dissipated) = (Vec::new(), Vec::new());
        for law in &scene.laws {
            let along = self.motion_of(law.along, &motion);
            let mut added = Table::default();
            for (forces, &ratio) in forces.iter_mut().zip(&along.ratios) {
                added.push(self.graph.multiply(law.law, ratio));
                forces.extend(added.last().map(|&force| (Number::ONE, force)));
            }
            effects.push((law.label.clone(), added));
            let power = self.graph.multiply(law.law, along.rate);
            match law.account {
                Account::Stored(energy) => potential.push((Number::ONE, energy)),
                Account::Dissipated => dissipated.push((Number::MINUS_ONE, power)),
                Account::Applied => applied.push((Number::ONE, power)),
            }
        }
        let contacts = self.derive_contacts(mechanism, scene);
        for (Contact { label, rate, law, .. }, model) in contacts.iter().zip(&scene.contacts) {
            // A slipping contact dissipates limit |s'|; for a sticking one s' = 0.
            if let ContactFormula::Friction { limit, given } = law {
                // The limit by a reaction follows from the motion.
                if model.bearing.is_none() {
                    let rate = self.graph.call(Function::Abs, &[*rate]);
                    dissipated.push((Number::ONE, self.graph.multiply(*limit, rate)));
                }
                masses.extend(given.iter().map(|&factor| (label.clone(), factor)));
            }
        }
        let mut sum = |terms: Vec<(Number, NodeId)>| {
            let sum = self.graph.sum(&terms);
            gather(&mut self.graph, sum, &motion)
        };
        let [kinetic, potential, applied, dissipated] = [kinetic, potential, applied, dissipated].map(&mut sum);
        let forces = forces.map(&mut sum);
        let mass_matrix = mass_matrix.map(|row| row.map(&mut sum));
        let mass_matrix = scene.inertia.is_some().then_some(mass_matrix);
        let drives = self.prescribed(mechanism, scene);
        let unreduced = scene.inertia.is_some().then(|| self.derive_unreduced(mechanism, scene));
        let has_joints = scene.requests.contains(&SceneRequest::Reactions) || !scene.opened().is_empty();
        let reactions = has_joints.then(|| self.derive_reactions(mechanism, id, scene));
        Scene {
            id,
            bias,
            mass_matrix,
            forces,
            parts: effects,
            contacts,
            masses,
            drives,
            kinks: Vec::new(),
            gap_changes: Vec::new(),
            kinetic,
            potential,
            applied,
            dissipated,
            unreduced,
            reactions,
            equilibrium: None,
        }
    }

    /// The moving parts of a body in a scene: a mass with two scalars, an inertia with one.
    pub(super) fn moving_parts(&mut self, index: BodyId, body: &model::Body, scene: &model::Scene) -> Vec<MovingPart> {
        let is_inert = scene.inertia.as_ref().is_some_and(|bodies| bodies.contains(&index));
        let fields = scene.weights.iter().filter(|(other, _)| *other == index).map(|(_, field)| *field);
        let fields: Vec<[NodeId; 2]> = fields.collect();
        let mut parts = Vec::new();
        if let Some((factor, center)) = body.mass
            && (is_inert || !fields.is_empty())
        {
            let field = |axis: usize| fields.iter().map(|field| (Number::ONE, field[axis])).collect::<Vec<_>>();
            let fields = [0, 1].map(|axis| self.graph.sum(&field(axis))).to_vec();
            parts.push(MovingPart { property: "mass", factor, scalars: center.to_vec(), fields, is_inert });
        }
        if let Some((factor, angle)) = body.inertia
            && is_inert
        {
            let fields = vec![self.graph.zero()];
            parts.push(MovingPart { property: "inertia", factor, scalars: vec![angle], fields, is_inert });
        }
        parts
    }

    /// The symbols of `u''` at `v'' = 0`.
    fn bias_symbols(&mut self) -> Table<UnknownId, SymbolId> {
        let names = self.unknowns.iter().map(|&unknown| format!("{}_bias", self.coordinates[unknown].name));
        names.map(|name| self.graph.symbol(name)).collect()
    }

    /// The scalar product x . y, simplified.
    fn scalar_product(&mut self, pairs: Vec<(NodeId, NodeId)>) -> NodeId {
        let terms: Vec<_> = pairs.into_iter().map(|(a, b)| (Number::ONE, self.graph.multiply(a, b))).collect();
        let sum = self.graph.sum(&terms);
        self.simplest(sum)
    }

    /// True if the expression is neither a sum nor a product with a sum as a factor.
    fn is_one_term(&self, node: NodeId) -> bool {
        let is_sum = |node: NodeId| matches!(self.graph.node(node), Node::Sum { .. });
        match self.graph.node(node) {
            Node::Product { factors, .. } => !factors.iter().any(|(base, _)| is_sum(*base)),
            _ => !is_sum(node),
        }
    }

    /// Simplifies an expression. The sines and cosines of the loop equations cost nothing, because they are computed
    /// for these.
    pub(super) fn simplest(&mut self, node: NodeId) -> NodeId {
        let given: BTreeSet<NodeId> = angles(&self.graph, &self.residual);
        simplify(&mut self.graph, &[node], &given)[0]
    }

    /// d scalar / d q.
    pub(super) fn row_of(&mut self, scalar: NodeId) -> Row<ColumnId> {
        let places = places_of(&self.coordinates, |c| c.value);
        jacobian(&mut self.graph, &[scalar], &places).remove(0)
    }

    /// The symbols of W, `q'` and `u''` at `v'' = 0`; M, Q and the energies are polynomials in these.
    fn motion_symbols(&mut self, bias: &Table<UnknownId, SymbolId>) -> BTreeSet<NodeId> {
        let rates = self.coordinates.iter().map(|coordinate| coordinate.rate);
        let symbols: Vec<SymbolId> = self.ratios.iter().flatten().chain(bias).copied().chain(rates).collect();
        symbols.into_iter().map(|symbol| self.graph.variable(symbol)).collect()
    }

    /// The motion of a scalar; `s_j` is its rate at v'j = 1 with the other input rates zero.
    fn motion_of(&mut self, scalar: NodeId, motion: &BTreeSet<NodeId>) -> ScalarMotion {
        let mut ratios = Table::default();
        for (input, names) in self.ratios.clone().enumerated() {
            let graph = &mut self.graph;
            let unknowns = self.unknowns.iter().zip(names);
            let mut seeds: BTreeMap<SymbolId, NodeId> =
                unknowns.map(|(&unknown, &name)| (self.coordinates[unknown].value, graph.variable(name))).collect();
            seeds.insert(self.coordinates[self.inputs[input]].value, graph.one());
            let direct = graph.differentiate(&[scalar], &seeds)[0];
            let gathered = gather(graph, direct, motion);
            ratios.push(self.simplest(gathered));
        }
        let seeds = along_rates(&mut self.graph, &self.coordinates);
        let rate = self.graph.differentiate(&[scalar], &seeds)[0];
        ScalarMotion { ratios, rate }
    }

    /// `s_0` of a scalar, from its rate.
    fn bias_of(&mut self, rate: NodeId, bias: &Table<UnknownId, SymbolId>) -> NodeId {
        // d/dt: q -> q', u' -> u'' at v'' = 0, v' -> 0.
        let mut seeds = along_rates(&mut self.graph, &self.coordinates);
        for (&unknown, &bias) in self.unknowns.iter().zip(bias) {
            seeds.insert(self.coordinates[unknown].rate, self.graph.variable(bias));
        }
        self.graph.differentiate(&[rate], &seeds)[0]
    }

    /// The laws of the driven inputs, with their derivatives.
    fn prescribed(&mut self, mechanism: &Mechanism, scene: &model::Scene) -> BTreeMap<InputId, Prescribed> {
        let one = self.graph.one();
        let seeds: BTreeMap<SymbolId, NodeId> = mechanism.time.iter().map(|&time| (time, one)).collect();
        let mut drives = BTreeMap::new();
        for drive in &scene.drives {
            drives.insert(drive.input, self.prescribed_motion(drive.law, &seeds));
        }
        drives
    }

    /// -gamma: the right side of `J u'' = -gamma` at `v'' = 0`.
    pub fn bias_side(&mut self) -> Table<RowId, NodeId> {
        self.gamma.clone().map(|gamma| self.graph.negate(gamma))
    }
}
