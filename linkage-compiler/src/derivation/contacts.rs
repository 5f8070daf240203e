//! Frictions and stops: the derivatives of the scalars s that they act along.
//!
//! s(q) has the derivatives `ds/dq`, and `s'' = ds/dq q'' + bias` with the quadratic terms `(s_q q')_q q'`.

use std::collections::BTreeSet;

use super::data::Derivation;
use super::jacobian::along_rates;
use super::scene::{Contact, ContactFormula};
use crate::graph::{Function, NodeId, SymbolId};
use crate::model::{self, ContactLaw, Mechanism};

impl Derivation {
    pub(super) fn derive_contacts(&mut self, mechanism: &Mechanism, scene: &model::Scene) -> Vec<Contact> {
        let motion = self.coordinates.iter().flat_map(|c| [c.value, c.rate]).chain(mechanism.time);
        let motion: BTreeSet<SymbolId> = motion.collect();
        let mut contacts = Vec::new();
        for model::Contact { label, along, law, .. } in &scene.contacts {
            let value = self.simplest(*along);
            let mut row = self.row_of(value);
            let seeds = along_rates(&mut self.graph, &self.coordinates);
            let mut rate = self.graph.differentiate(&[value], &seeds)[0];
            let mut bias = self.graph.differentiate(&[rate], &seeds)[0];
            let law = match law {
                ContactLaw::Friction(factors) => {
                    let is_still = |factor: &NodeId| {
                        !self.graph.symbols_of(&[*factor]).iter().any(|symbol| motion.contains(symbol))
                    };
                    let still: Vec<NodeId> = factors.iter().copied().filter(is_still).collect();
                    // Without a limit the friction has no force, and needs no direction where a length is zero.
                    if self.graph.reachable(&[value]).into_iter().any(|node| self.graph.is_length(node)) {
                        let coefficient = self.product(&still);
                        for derivative in row.values_mut().chain([&mut rate, &mut bias]) {
                            *derivative = self.unless_zero(coefficient, *derivative);
                        }
                    }
                    let limit = self.product(factors);
                    let given = still.into_iter().filter(|&factor| self.graph.constant_value(factor).is_none());
                    ContactFormula::Friction { limit, given: given.collect() }
                }
                ContactLaw::Stop { range, restitution } => {
                    // Between its ends a stop has no force, and needs no direction where its length is zero.
                    if self.graph.is_length(value) {
                        let distances = range.map(|end| (self.graph.subtract(value, end), 1));
                        let distance = self.graph.product(&distances);
                        for derivative in row.values_mut().chain([&mut rate, &mut bias]) {
                            let without_force = self.unless_zero(value, *derivative);
                            let arguments = [distance, without_force, *derivative];
                            *derivative = self.graph.call(Function::IfNonzero, &arguments);
                        }
                    }
                    ContactFormula::Stop { range: *range, restitution: *restitution }
                }
            };
            contacts.push(Contact { label: label.clone(), value, row, rate, bias, law });
        }
        contacts
    }

    fn product(&mut self, factors: &[NodeId]) -> NodeId {
        let powers: Vec<(NodeId, i32)> = factors.iter().map(|&factor| (factor, 1)).collect();
        self.graph.product(&powers)
    }

    /// A value, or 0 where `factor` is zero.
    fn unless_zero(&mut self, factor: NodeId, value: NodeId) -> NodeId {
        let zero = self.graph.zero();
        self.graph.call(Function::IfNonzero, &[factor, value, zero])
    }
}
