//! The functions of a scene with frictions and stops: its contacts, and the equations of motion before they are solved.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::kernel::{Operand, Source};
use super::super::names::{ident, string};
use super::super::tokens::Tokens;
use super::scene::{Parts, Setting};
use super::{Body, Methods, argument_of, bind, columns_of, fenced, lines, literal};
use crate::derivation::ContactFormula;
use crate::graph::NodeId;
use crate::lower::Stage;

impl Methods<'_> {
    /// Each friction and stop with its scalar, the derivatives of that, and its numbers.
    pub(super) fn contacts(&mut self, place: &Setting, parts: Parts) {
        let (q, rate, coordinates) =
            (self.arguments.q.clone(), self.arguments.rate.clone(), self.types.coordinates.clone());
        let mut docs = lines(["The frictions and stops at a position and the velocity q', in the order of the scene."]);
        let code = parts.map(|(kernels, scene)| {
            let formulas = scene.contacts.iter().map(|contact| {
                let value = kernels.text(contact.value);
                match &contact.law {
                    ContactFormula::Friction { limit, .. } => {
                        format!("{}: |f| <= {} along {value}", contact.label, kernels.text(*limit))
                    }
                    ContactFormula::Stop { range: [lower, upper], restitution } => {
                        let [lower, upper, restitution] = [lower, upper, restitution].map(|&node| kernels.text(node));
                        format!("{}: {lower} <= {value} <= {upper}, s'+ = -({restitution}) s'-", contact.label)
                    }
                }
            });
            docs.extend(fenced(formulas.collect::<Vec<_>>().into_iter()));
            let zero = kernels.derivation.graph.zero();
            let (unknowns, inputs) = (kernels.derivation.unknowns.clone(), kernels.derivation.inputs.clone());
            let mut returned: Vec<NodeId> = Vec::new();
            for contact in &scene.contacts {
                let entries = unknowns.iter().chain(&inputs);
                returned.extend(entries.map(|index| contact.row.get(index).copied().unwrap_or(zero)));
                returned.extend([contact.value, contact.bias]);
                match &contact.law {
                    ContactFormula::Friction { limit, .. } => returned.push(*limit),
                    ContactFormula::Stop { range, restitution } => {
                        returned.extend(range);
                        returned.push(*restitution);
                    }
                }
            }
            let sources = vec![
                self.coordinates(kernels, &q, |c| c.value),
                Source { from: Tokens::behind(&rate), ..self.coordinates(kernels, &rate, |c| c.rate) },
            ];
            let code = self.on(place, kernels, sources, &[Stage::Return(returned)]);
            let mut results = code.results.iter();
            let mut take = |many: usize| results.by_ref().take(many).collect::<Vec<&Operand>>();
            let mut contacts = TokenStream::new();
            for contact in &scene.contacts {
                let (of_unknowns, of_inputs) = (take(unknowns.len()), take(inputs.len()));
                let numbers = take(2);
                let value = super::member(&ident("value"), numbers[0]);
                let bias = super::member(&ident("bias"), numbers[1]);
                let law = match contact.law {
                    ContactFormula::Friction { .. } => {
                        let limit = take(1);
                        let limit = super::member(&ident("limit"), limit[0]);
                        quote!(ContactLaw::Friction { #limit })
                    }
                    ContactFormula::Stop { .. } => {
                        let numbers = take(3);
                        let names = ["lower", "upper", "restitution"];
                        let members = names.iter().zip(numbers).map(|(name, value)| super::member(&ident(name), value));
                        quote!(ContactLaw::Stop { #(#members),* })
                    }
                };
                let name = string(&contact.label);
                contacts.extend(quote! {
                    Contact {
                        name: #name,
                        along: Along {
                            #value,
                            unknowns: SVector::from([#(#of_unknowns),*]),
                            inputs: SVector::from([#(#of_inputs),*]),
                            #bias,
                        },
                        law: #law,
                    },
                });
            }
            Body::new(code, quote!(sound(Self::NAME, [#contacts])), ["Along", "Contact", "ContactLaw", "sound"])
        });
        docs.extend(lines([
            "",
            "# Errors",
            "`NotFinite` with the name of the effect that has no finite value, `Negative` with that of the friction whose",
            "limit is negative.",
        ]));
        let (u, v) = (literal(self.driver.unknowns.len()), literal(place.inputs.len()));
        let count = literal(place.scene.contacts.len());
        let [time, q, rate] = [&place.time, &q, &rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn contacts(&self, #time: T, #q: &#coordinates<T>, #rate: &#coordinates<T>)
            -> Result<[Contact<T, #u, #v>; #count], Error>);
        self.uses.insert("Contact");
        self.function(&docs, signature, code);
    }

    /// M, Q, W and u'' at v'' = 0 in one kernel.
    pub(super) fn equations(&mut self, place: &Setting, parts: Parts) {
        let (u, v) = (self.driver.unknowns.len(), place.inputs.len());
        let code = parts.map(|(kernels, scene)| {
            let matrix = scene.mass_matrix.iter().flatten().flatten();
            let mut returned: Vec<NodeId> = matrix.chain(&scene.forces).copied().collect();
            let ratios: Vec<_> = kernels.derivation.ratios.iter().flatten().copied().collect();
            returned.extend(kernels.variables(&ratios));
            returned.extend(kernels.variables(&scene.bias));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = code.results.clone();
            let (entries, rest) = results.split_at(v * v);
            let (forces, rest) = rest.split_at(v);
            let (ratios, biases) = rest.split_at(u * v);
            let wishes = self.pair_names(place, "inertia");
            let (entry_bindings, entries) = bind(entries, &wishes, &mut code.taken);
            let wishes: Vec<String> = place.inputs.iter().map(|input| format!("{input}_force")).collect();
            let (bindings, forces) = bind(forces, &wishes, &mut code.taken);
            let mut checked = entries.clone();
            checked.extend(forces.iter().chain(ratios).chain(biases).cloned());
            let verdict = self.blamed(place, &mut code, "the equations of motion", &checked);
            let (mass, ratios) = (columns_of(&entries, v), ratios.chunks(u).map(|column| quote!([#(#column),*])));
            let tail = quote! {
                #entry_bindings #bindings #verdict
                Ok(Equations {
                    mass: #mass,
                    forces: SVector::from([#(#forces),*]),
                    ratios: SMatrix::from([#(#ratios),*]),
                    bias: SVector::from([#(#biases),*]),
                })
            };
            self.with_rates(Body::new(code, tail, ["Equations"]))
        });
        let docs = lines([
            "M and Q of M v'' = Q without frictions and stops, W of u' = W v', and u'' at v'' = 0.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` with the name of the body or the effect that has no finite",
            "value.",
        ]);
        let (nu, nv) = (literal(u), literal(v));
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn equations(#arguments) -> Result<Equations<T, #nu, #nv>, Error>);
        self.uses.insert("Equations");
        self.function(&docs, signature, code);
    }
}
