//! Frictions and stops: the derivatives of the scalars s that they act along.
//!
//! s(q) has the derivatives `ds/dq`, and s'' = `ds/dq` q'' + bias with the quadratic terms `(s_q q')_q q'`.

use std::collections::BTreeSet;

use super::data::Derivation;
use super::jacobian::along_rates;
use super::scene::{Contact, ContactFormula};
use crate::graph::{NodeId, SymbolId};
use crate::model::{self, ContactLaw, Mechanism};

impl Derivation {
    pub(super) fn derive_contacts(&mut self, mechanism: &Mechanism, scene: &model::Scene) -> Vec<Contact> {
        let motion = self.coordinates.iter().flat_map(|c| [c.value, c.rate]).chain(mechanism.time);
        let motion: BTreeSet<SymbolId> = motion.collect();
        let mut contacts = Vec::new();
        for model::Contact { label, along, law, .. } in &scene.contacts {
            let value = self.simplest(*along);
            let row = self.row_of(value);
            let seeds = along_rates(&mut self.graph, &self.coordinates);
            let rate = self.graph.differentiate(&[value], &seeds)[0];
            let bias = self.graph.differentiate(&[rate], &seeds)[0];
            let law = match law {
                ContactLaw::Friction(factors) => {
                    let powers: Vec<(NodeId, i32)> = factors.iter().map(|&factor| (factor, 1)).collect();
                    let is_given = |factor: &NodeId| {
                        let symbols = self.graph.symbols_of(&[*factor]);
                        !symbols.is_empty() && !symbols.iter().any(|symbol| motion.contains(symbol))
                    };
                    let given = factors.iter().copied().filter(is_given).collect();
                    ContactFormula::Friction { limit: self.graph.product(&powers), given }
                }
                ContactLaw::Stop { range, restitution } => {
                    ContactFormula::Stop { range: *range, restitution: *restitution }
                }
            };
            contacts.push(Contact { label: label.clone(), value, row, rate, bias, law });
        }
        contacts
    }
}
