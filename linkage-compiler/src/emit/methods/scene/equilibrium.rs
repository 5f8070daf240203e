//! Where the forces vanish at rest.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::{Body, Methods, argument_of, bind, check_finite, lines, literal};
use super::{Parts, Setting};
use crate::derivation::Form;
use crate::graph::NodeId;
use crate::lower::{Stage, needed};

impl Methods<'_> {
    /// The forces at rest with their derivatives, and where they vanish.
    pub(super) fn equilibrium(&mut self, place: &Setting, parts: Parts) {
        let (time, q) = (place.time.clone(), self.arguments.q.clone());
        let (coordinates, count) = (self.types.coordinates.clone(), literal(place.free.len()));
        let code = parts.map(|(kernels, scene)| {
            let Some(equilibrium) = &scene.equilibrium else { return Body::plain(TokenStream::new(), [], []) };
            let (free, many) = (&place.free, place.free.len());
            let mut returned: Vec<NodeId> = free.iter().map(|&at| equilibrium.forces[at]).collect();
            returned.extend(free.iter().map(|&at| equilibrium.sizes[at]));
            returned
                .extend(free.iter().flat_map(|&column| free.iter().map(move |&row| equilibrium.slopes[row][column])));
            let mut stages = kernels.derivation.solution(&equilibrium.systems, Form::Entries);
            stages.push(Stage::Return(returned));
            let stages = needed(&kernels.derivation.graph, kernels.with_determinants(stages));
            let mut code = self.on_state(place, kernels, &stages);
            let names: Vec<&Ident> = free.iter().map(|&at| &place.inputs[at]).collect();
            let mut wishes: Vec<String> = names.iter().map(|input| format!("{input}_force")).collect();
            wishes.extend(names.iter().map(|input| format!("{input}_force_size")));
            for input in &names {
                wishes.extend(names.iter().map(|other| format!("{other}_force_by_{input}")));
            }
            let (bindings, values) = bind(&code.results, &wishes, &mut code.taken);
            let finite = check_finite(&mut code, "the forces at rest", &values);
            let (forces, rest) = values.split_at(many);
            let (sizes, slopes) = rest.split_at(many);
            let columns = slopes.chunks(many).map(|column| quote!([#(#column),*]));
            let balance = quote!(forces: [#(#forces),*], sizes: [#(#sizes),*], slopes: [#(#columns),*]);
            Body::new(code, quote!(#bindings #finite Ok(Balance { #balance })), [])
        });
        let docs = lines([
            "The forces of the free inputs at rest, the sums of the magnitudes of their parts, and their derivatives by these",
            "inputs along the closures, column by column: an equilibrium of one input is stable where its slope is negative.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a force, its size or a derivative is not finite.",
        ]);
        let [own_time, own] = [&time, &q].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn balance(&self, #own_time: T, #own: &#coordinates<T>)
            -> Result<Balance<T, #count>, Error>);
        self.function(&docs, signature, code);
        let names: Vec<&Ident> = place.free.iter().map(|&at| &place.inputs[at]).collect();
        let inner = &place.field;
        let driven: Vec<&Ident> = place.driven.iter().map(|&at| &place.inputs[at]).collect();
        let drives = (!driven.is_empty()).then(|| {
            let laws = driven.iter().map(|input| quote!([#input, ..]));
            quote!(let [#(#laws),*] = self.drives(#time);)
        });
        let guess = &self.arguments.guess;
        let tokens = quote! {
            #drives
            equilibrium(Self::NAME, [#(#guess.#names),*], |[#(#names),*]| {
                let #q = newton(&self.#inner, &#coordinates { #(#names,)* #(#driven,)* ..*#guess })?;
                if !#q.same_branch {
                    return Err(Error::OtherBranch { mechanism: Self::NAME, group: "a loop" });
                }
                Ok((#q.coordinates, self.balance(#time, &#q.coordinates)?))
            })
        };
        let docs = lines([
            "The position near the guess where the forces of the free inputs vanish at rest, by Newton's method; it may be",
            "stable or not.",
            "",
            "# Errors",
            "`NotConverged` if there is none to be found, `OtherBranch` if the guess belongs to no position of its branch,",
            "`NotFinite` if a number is not finite.",
        ]);
        let body = Body::plain(tokens, [&time, guess], ["Balance", "equilibrium", "newton"]);
        let signature =
            quote!(pub fn equilibrium(&self, #time: T, #guess: &#coordinates<T>) -> Result<#coordinates<T>, Error>);
        self.function(&docs, signature, Some(body));
    }
}
