//! The kinks of the laws of a scene: the arguments of `abs` and other functions at whose zeros a law is not smooth.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::data::Derivation;
use super::scene::{Kink, Prescribed};
use crate::graph::{Function, Node, NodeId, SymbolId, operation};
use crate::model::{self, Account, ContactLaw, Driver, Mechanism};

impl Derivation {
    /// A law of motion with its derivatives. Those of |x| are (x / |x|) `x'` and (x / |x|) `x''`, where x / |x| is constant:
    /// the derivative of the quotient would be a difference of large terms near a kink.
    pub(super) fn prescribed_motion(&mut self, law: NodeId, seeds: &BTreeMap<SymbolId, NodeId>) -> Prescribed {
        let value = self.without_squares(law);
        let (mut by_sign, mut signs) = (FxHashMap::default(), FxHashMap::default());
        for node in self.graph.reachable(&[value]) {
            let Node::Call(Function::Abs, arguments) = self.graph.node(node) else { continue };
            let argument = arguments[0];
            let sign = self.graph.symbol("sign");
            let sign = self.graph.variable(sign);
            let inner = self.graph.replace(&[argument], &by_sign)[0];
            by_sign.insert(node, self.graph.multiply(sign, inner));
            signs.insert(sign, self.graph.divide(argument, node));
        }
        let smooth = self.graph.replace(&[value], &by_sign)[0];
        let rate = self.graph.differentiate(&[smooth], seeds)[0];
        let acceleration = self.graph.differentiate(&[rate], seeds)[0];
        let derivatives = self.graph.replace(&[rate, acceleration], &signs);
        Prescribed { value, rate: derivatives[0], acceleration: derivatives[1] }
    }

    /// A law in which |x| is not written as a square root or a distance; itself if it has no kink.
    fn without_squares(&mut self, law: NodeId) -> NodeId {
        let has_kink = self.graph.reachable(&[law]).into_iter().any(|node| match self.graph.node(node) {
            Node::Call(function @ (Function::Sqrt | Function::Hypot), arguments) => {
                !(operation(*function).kinks)(&self.graph, arguments).is_empty()
            }
            _ => false,
        });
        if has_kink { self.simplest(law) } else { law }
    }

    /// Each argument once, with the first effect that contains it. A scene without inertia has no motion.
    pub(super) fn derive_kinks(&mut self, mechanism: &Mechanism, driver: &Driver, scene: &model::Scene) -> Vec<Kink> {
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
            let formulas: Vec<NodeId> = formulas.into_iter().map(|formula| self.without_squares(formula)).collect();
            for node in self.graph.reachable(&formulas) {
                let Node::Call(function, arguments) = self.graph.node(node) else { continue };
                for argument in (operation(*function).kinks)(&self.graph, arguments) {
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
