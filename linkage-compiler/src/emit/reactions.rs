//! The type of the forces in the joints of a scene.

use proc_macro2::TokenStream;
use quote::quote;

use super::names::{comment, ident};
use super::numbers::literal;
use super::types::derives;
use crate::model::{LoadKind, Mechanism};
use crate::program::{Joint, MULTIPLIERS, SceneSignatures};

pub(super) fn types(mechanism: &Mechanism, signatures: &SceneSignatures, root: &TokenStream) -> Option<TokenStream> {
    if !signatures.has_reactions() {
        return None;
    }
    let SceneSignatures { scene, joints: shown, reactions_type, unknowns, types, .. } = signatures;
    let (visibility, name, derives) = (&mechanism.visibility, ident(reactions_type), derives(mechanism, root));
    let driver = ident(&types.driver);
    let [mut members, mut joints, mut forces] = [const { Vec::new() }; 3];
    for &Joint { place, .. } in shown {
        let load = &mechanism.opened.loads[place];
        let place = literal(place);
        let of_implied = if load.is_determined {
            ""
        } else {
            " It is not determined: `implied` loops may carry a part of it. This is the force without them."
        };
        let left_out = load
            .left_out(&mechanism.graph)
            .map(|equations| format!(" The forces of {equations} act along the scalars there; they are not included."));
        let of_implied = format!("{of_implied}{}", left_out.unwrap_or_default());
        match &load.kind {
            LoadKind::Pin { joint, link } => {
                let doc = comment(&format!(
                    " The force on {link} in the pin at {joint}, along x and y of the ground.{of_implied}"
                ));
                let field = ident(&load.field);
                members.push(quote!(#[doc = #doc] pub #field: #root::__rt::Vector2<T>));
                let (name, at, on) = (&load.field, joint, link);
                joints.push(quote!(#root::__rt::Joint::Pin { name: #name, at: #at, on: #on, place: #place }));
                forces.push(quote!([self.#field.x, self.#field.y]));
            }
            LoadKind::Guide { coordinate, guide, block, end } => {
                let end = end.as_deref().unwrap_or("the end of the vector of this length");
                let normal = format!(
                    " The normal force of {guide} on {block} in the guide of {coordinate}, positive a quarter turn \
                     anticlockwise from its direction.{of_implied}"
                );
                let moment =
                    format!(" The moment of {guide} on {block} about {end} in the guide of {coordinate}.{of_implied}");
                let fields: Vec<_> = load.fields().iter().map(|field| ident(field)).collect();
                for (field, doc) in fields.iter().zip([normal, moment]) {
                    let doc = comment(&doc);
                    members.push(quote!(#[doc = #doc] pub #field: T));
                }
                let (name, on) = (&load.field, block);
                joints.push(quote!(#root::__rt::Joint::Guide { name: #name, on: #on, place: #place }));
                forces.push(quote!([#(self.#fields),*]));
            }
        }
    }
    if signatures.has_multipliers() {
        let (field, unknowns) = (ident(MULTIPLIERS), literal(*unknowns));
        let doc = comment(
            " The Lagrange multipliers lambda of `M q'' + Psi_q' lambda = F`, two for each `loop` and one for each \
             `equation`. For a `loop`, lambda is the force of its left side on its right side where they meet.",
        );
        members.push(quote!(#[doc = #doc] pub #field: #root::__rt::SVector<T, #unknowns>));
    }
    let title = comment(&format!(" The forces in the joints of [`{scene}`]."));
    Some(quote! {
        #[doc = #title]
        #derives
        #visibility struct #name<T: #root::__rt::Scalar = f64> { #(#members),* }
        impl<T: #root::__rt::Real> #root::__rt::JointForces<T> for #name<T> {
            type Mechanism = #driver<T>;
            const JOINTS: &'static [#root::__rt::Joint] = &[#(#joints),*];
            fn each(&self) -> impl ::core::iter::Iterator<Item = [T; 2]> {
                ::core::iter::IntoIterator::into_iter([#(#forces),*])
            }
        }
    })
}
