//! The laws of drives, and the forces that they take.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::{Body, Methods, argument_of, bind, lines, literal, without_result};
use super::{ERRORS, Parts, Setting};
use crate::derivation::Prescribed;
use crate::emit::kernel::Operand;
use crate::lower::Stage;

impl Methods<'_> {
    /// The laws of the driven inputs with their derivatives.
    pub(super) fn drives(&mut self, place: &Setting, parts: Parts) {
        let count = literal(place.driven.len());
        let list: Vec<String> = place.driven.iter().map(|&at| format!("`{}`", place.inputs[at])).collect();
        let docs =
            vec![format!("The value, the rate and the acceleration that are prescribed of {}.", list.join(", "))];
        let code = parts.map(|(kernels, scene)| {
            let laws = scene.drives.values();
            let nodes = laws.flat_map(|Prescribed { value, rate, acceleration }| [*value, *rate, *acceleration]);
            let code = self.on_state(place, kernels, &[Stage::Return(nodes.collect())]);
            let rows = code.results.chunks(3).map(|row| quote!([#(#row),*]));
            let tail = quote!([#(#rows),*]);
            Body::new(code, tail, [])
        });
        let time = argument_of(&place.time, code.as_ref());
        let signature = quote!(#[must_use] pub fn drives(&self, #time: T) -> [[T; 3]; #count]);
        self.function(&without_result(docs), signature, code);
    }

    /// Inverse dynamics: `M_d v'' - Q_d`.
    pub(super) fn drive_forces(&mut self, place: &Setting, parts: Parts) {
        let count = literal(place.driven.len());
        let list: Vec<String> = place.driven.iter().map(|&at| format!("`{}`", place.inputs[at])).collect();
        let mut docs = vec![
            format!(
                "The forces, of angles the torques, that drive {} by inverse dynamics: M v'' - Q,",
                list.join(", ")
            ),
            "at this position and these rates of the inputs.".to_owned(),
        ];
        if !place.scene.contacts.is_empty() {
            docs[1] = "at this position and these rates of the inputs, without frictions and stops.".to_owned();
        }
        docs.extend(lines(ERRORS));
        let code = parts.map(|(kernels, scene)| {
            let free = if scene.mass_matrix.is_some() { place.free.clone() } else { Vec::new() };
            let mut returned = Self::minor(scene, &free, &free);
            returned.extend(Self::right_sides(place, kernels, scene, &free));
            returned.extend(Self::minor(scene, &place.driven, &free));
            let sides = Self::right_sides(place, kernels, scene, &place.driven);
            returned.extend(sides.into_iter().map(|side| kernels.derivation.graph.negate(side)));
            let mut code = self.on_motion(place, kernels, scene, returned);
            let results = std::mem::take(&mut code.results);
            let (entries, rest) = results.split_at(free.len().pow(2));
            let (sides, rest) = rest.split_at(free.len());
            let (coupling, forces) = rest.split_at(free.len() * place.driven.len());
            let (solve, names) = if free.is_empty() {
                (TokenStream::new(), Vec::new())
            } else {
                Self::solve_free(place, &mut code, entries, sides)
            };
            let forces = forces.iter().enumerate().map(|(row, force)| {
                let row = coupling.iter().skip(row * free.len()).zip(&names);
                let terms = row.map(|(entry, acceleration)| quote!(+ (#entry) * #acceleration));
                let formula = quote!(#force #(#terms)*);
                if names.is_empty() { force.clone() } else { Operand::Formula(formula.into()) }
            });
            code.operations.multiplications += coupling.len();
            code.operations.additions += coupling.len();
            let forces: Vec<Operand> = forces.collect();
            let wishes: Vec<String> = place.driven.iter().map(|&at| format!("{}_drive", place.inputs[at])).collect();
            let (bindings, forces) = bind(&forces, &wishes, &mut code.taken);
            let verdict = self.blamed(place, &mut code, "the driving force", &forces);
            self.with_rates(Body::new(code, quote!(#solve #bindings #verdict Ok([#(#forces),*])), []))
        });
        let arguments = self.state_arguments(place, code.as_ref());
        let signature = quote!(pub fn drive_forces(#arguments) -> Result<[T; #count], Error>);
        self.function(&docs, signature, code);
    }
}
