//! Energy and power.

use proc_macro2::Ident;
use quote::quote;

use super::super::{Body, Methods, argument_of, bind, check_finite, lines};
use super::{ERRORS, Parts, Setting};
use crate::emit::kernel::Operand;
use crate::emit::names::ident;

impl Methods<'_> {
    pub(super) fn energy(&mut self, place: &Setting, parts: Parts) {
        let code = parts.map(|(kernels, scene)| {
            let mut code = self.on_motion(place, kernels, scene, vec![scene.kinetic, scene.potential]);
            let wishes = ["kinetic", "potential"].map(str::to_owned);
            let (bindings, values) = bind(&code.results, &wishes, &mut code.taken);
            let verdict = check_finite(&mut code, "the energy", &values);
            let members = ["kinetic", "potential"]
                .into_iter()
                .zip(&values)
                .map(|(name, value)| super::super::member(&ident(name), value));
            self.with_rates(Body::new(code, quote!(#bindings #verdict Ok(Energy { #(#members),* })), ["Energy"]))
        });
        let mut docs = lines(["The kinetic energy, and the potential energy of gravity, springs and potentials."]);
        docs.extend(lines(["", "# Errors", "`Singular` where J has no inverse, `NotFinite` if it is not finite."]));
        let (coordinates, inputs) = (&self.types.coordinates, &self.types.inputs);
        let [q, rate] = [&self.arguments.q, &self.arguments.rate].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn energy(&self, #q: &#coordinates<T>, #rate: impl Into<#inputs<T>>) -> Result<Energy<T>, Error>);
        self.uses.insert("Energy");
        self.function(&docs, signature, code);
    }

    pub(super) fn power(&mut self, place: &Setting, parts: Parts) {
        let (time, q, rate) = (place.time.clone(), self.arguments.q.clone(), self.arguments.rate.clone());
        let code = parts.map(|(kernels, scene)| {
            let mut returned = vec![scene.applied, scene.dissipated];
            let inputs = kernels.derivation.inputs.clone();
            let known = if scene.contacts.is_empty() { place.driven.as_slice() } else { &[] };
            let rates: Vec<usize> = known.iter().map(|&at| inputs[at]).collect();
            let rates = kernels.rates(&rates);
            returned.extend(kernels.variables(&rates));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = std::mem::take(&mut code.results);
            let (values, speeds) = results.split_at(2);
            let drives = (!speeds.is_empty()).then(|| {
                let names: Vec<Ident> = speeds
                    .iter()
                    .map(|speed| ident(&code.taken.unique(&format!("{}_drive", quote!(#speed)))))
                    .collect();
                (quote!(let [#(#names),*] = self.drive_forces(#time, #q, #rate)?;), names)
            });
            let (calls, names) = drives.unwrap_or_default();
            if !names.is_empty() {
                code.arguments.extend([time.clone(), q.clone(), rate.clone()]);
                let inner = self.kernels.iter().find(|(name, _)| name == "drive_forces");
                code.operations = inner.map_or(code.operations, |(_, inner)| code.operations.plus(*inner));
            }
            let driven = names.iter().zip(speeds).map(|(force, speed)| quote!(#force * #speed));
            let applied = match (&values[0], names.is_empty()) {
                (value, true) => value.clone(),
                (Operand::Constant(_), false) => Operand::Formula(quote!(#(#driven)+*).into()),
                (value, false) => Operand::Formula(quote!(#value #(+ #driven)*).into()),
            };
            let wishes = ["applied", "dissipated"].map(str::to_owned);
            let (bindings, values) = bind(&[applied, values[1].clone()], &wishes, &mut code.taken);
            let verdict = self.blamed(place, &mut code, "the power", &values);
            let members = ["applied", "dissipated"]
                .into_iter()
                .zip(&values)
                .map(|(name, value)| super::super::member(&ident(name), value));
            self.with_rates(Body::new(code, quote!(#calls #bindings #verdict Ok(Power { #(#members),* })), ["Power"]))
        });
        let mut docs = match (place.scene.contacts.is_empty(), place.driven.is_empty()) {
            (true, _) => lines([
                "The power of forces, torques and drives, and that of dampers: the energy changes by their difference.",
            ]),
            (false, true) => lines([
                "The power of forces and torques, and that of dampers and frictions, which take limit |s'|: between",
                "impacts the energy changes by their difference.",
            ]),
            (false, false) => lines([
                "The power of forces and torques, and that of dampers and frictions, which take limit |s'|. That of the",
                "drives depends on what sticks, and is not among them.",
            ]),
        };
        docs.extend(lines(ERRORS));
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn power(#arguments) -> Result<Power<T>, Error>);
        self.uses.insert("Power");
        self.function(&docs, signature, code);
    }
}
