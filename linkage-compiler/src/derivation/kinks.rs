//! The kinks of the laws of a scene: the arguments of `abs` and other functions at whose zeros a law is not smooth.

use std::collections::BTreeSet;

use super::data::Derivation;
use super::scene::Kink;
use crate::graph::{Node, NodeId, SymbolId};
use crate::model::{self, Account, ContactLaw, Driver, Mechanism};

impl Derivation {
    /// Each argument once, with the first effect that contains it. A scene without inertia has no motion.
    pub(super) fn derive_kinks(&self, mechanism: &Mechanism, driver: &Driver, scene: &model::Scene) -> Vec<Kink> {
        let Some(inert) = &scene.inertia else { return Vec::new() };
        let mut laws: Vec<(String, Vec<NodeId>)> = Vec::new();
        for drive in &scene.drives {
            let name = &mechanism.coordinates[driver.inputs[drive.input]].name.text;
            laws.push((format!("drive {name}"), vec![drive.law]));
        }
        for law in &scene.laws {
            let stored = match law.account {
                Account::Stored(potential) => Some(potential),
                Account::Dissipated | Account::Applied => None,
            };
            laws.push((law.label.clone(), [law.law, law.along].into_iter().chain(stored).collect()));
        }
        for contact in &scene.contacts {
            let mut formulas = vec![contact.along];
            if let ContactLaw::Friction(factors) = &contact.law {
                formulas.extend(factors);
            }
            laws.push((contact.label.clone(), formulas));
        }
        for &index in inert {
            let body = &mechanism.bodies[index];
            let centre = body.mass.iter().flat_map(|(_, centre)| *centre);
            let angle = body.inertia.iter().map(|(_, angle)| *angle);
            laws.push((format!("body {}", body.name.text), centre.chain(angle).collect()));
        }
        let motion = self.coordinates.iter().flat_map(|coordinate| [coordinate.value, coordinate.rate]);
        let motion: BTreeSet<SymbolId> = motion.collect();
        let mut kinks: Vec<Kink> = Vec::new();
        for (label, formulas) in laws {
            for node in self.graph.reachable(&formulas) {
                let Node::Call(function, arguments) = self.graph.node(node) else { continue };
                for argument in (function.operation().kinks)(&self.graph, arguments) {
                    let symbols = self.graph.symbols_of(&[argument]);
                    let moves = symbols.iter().any(|symbol| motion.contains(symbol));
                    let is_timed = !moves && mechanism.time.is_some_and(|time| symbols.contains(&time));
                    if (moves || is_timed) && !kinks.iter().any(|kink| kink.argument == argument) {
                        kinks.push(Kink { label: label.clone(), argument, is_timed });
                    }
                }
            }
        }
        kinks
    }
}
