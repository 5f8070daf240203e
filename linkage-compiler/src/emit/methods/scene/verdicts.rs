//! What is refused, and what is to blame.

use quote::quote;

use super::super::{Body, Methods, argument_of, lines};
use super::{Parts, Setting};
use crate::derivation::ContactFormula;
use crate::emit::names::string;
use crate::graph::NodeId;
use crate::lower::{Operations, Stage};

impl Methods<'_> {
    pub(super) fn check(&mut self, place: &Setting, parts: Parts) {
        let code = parts.map(|(kernels, scene)| {
            let mut nodes: Vec<NodeId> = scene.masses.iter().map(|(_, node)| *node).collect();
            let mut stops = Vec::new();
            for contact in &scene.contacts {
                if let ContactFormula::Stop { range, restitution } = contact.law {
                    stops.push(string(&contact.label));
                    nodes.extend(range);
                    nodes.push(restitution);
                }
            }
            let code = self.on_state(place, kernels, &[Stage::Return(nodes)]);
            let (masses, ends) = code.results.split_at(scene.masses.len());
            let pairs = scene.masses.iter().zip(masses).map(|((label, _), value)| {
                let label = string(label);
                quote!((#label, #value))
            });
            let masses = quote!(not_negative::<T, _>(Self::NAME, [#(#pairs),*]));
            if stops.is_empty() {
                return Body::new(code, masses, ["not_negative"]);
            }
            let ends = stops.iter().zip(ends.chunks(3)).map(|(label, values)| quote!((#label, #(#values),*)));
            let tail = quote!(#masses?; stops(Self::NAME, [#(#ends),*]));
            Body::new(code, tail, ["not_negative", "stops"])
        });
        let docs = if place.scene.contacts.is_empty() {
            lines([
                "Refuses parameters that no body has.",
                "",
                "# Errors",
                "`Negative` if a mass or an inertia is negative, `NotFinite` if it is not finite, with its name.",
            ])
        } else {
            lines([
                "Refuses parameters that no body, no friction and no stop has.",
                "",
                "# Errors",
                "With its name: `Negative` if a mass, an inertia or a friction is negative, `NoRange` if nothing is left between",
                "stops, `Restitution` if one is not between 0 and 1, `NotFinite` if a number is not finite.",
            ])
        };
        self.function(&docs, quote!(pub fn check(&self) -> Result<(), Error>), code);
    }

    /// Which body or effect has no finite value.
    pub(super) fn blame(&mut self, place: &Setting, parts: Parts) {
        let (coordinates, inputs) = (self.types.coordinates.clone(), self.types.inputs.clone());
        let code = parts.map(|(kernels, scene)| {
            let mut labels = Vec::new();
            let mut nodes = Vec::new();
            for (label, parts) in &scene.parts {
                let label = string(label);
                for &part in parts.iter().filter(|&&part| kernels.derivation.graph.constant_value(part).is_none()) {
                    labels.push(label.clone());
                    nodes.push(part);
                }
            }
            let mut code = self.on_motion(place, kernels, scene, nodes);
            // It is not called where all is well.
            code.operations = Operations::default();
            let results = &code.results;
            let tail = quote!(finite_each::<T, _>(Self::NAME, [#((#labels, #results)),*]));
            Body::new(code, tail, ["finite_each"])
        });
        let [time, q, rate] =
            [&place.time, &self.arguments.q, &self.arguments.rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature =
            quote!(#[cold] fn blame(&self, #time: T, #q: &#coordinates<T>, #rate: #inputs<T>) -> Result<(), Error>);
        let docs = lines(["Refuses the body or the effect that has no finite value, by its name."]);
        self.function(&docs, signature, code);
    }
}
