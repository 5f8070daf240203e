//! The type with one value for each drive of a scene.

use proc_macro2::TokenStream;
use quote::quote;

use super::Declared;
use super::names::{comment, ident};
use super::types::{derives, field};
use crate::model::Kind;
use crate::program::SceneSignatures;

pub(super) fn types(of: Declared<'_>, signatures: &SceneSignatures, root: &TokenStream) -> Option<TokenStream> {
    let (Declared { mechanism, driver }, SceneSignatures { scene, drives_type, driven, .. }) = (of, signatures);
    if driven.is_empty() {
        return None;
    }
    let (visibility, name, derives) = (&mechanism.visibility, ident(drives_type), derives(mechanism, root));
    let members = driven.iter().map(|&at| {
        let coordinate = &mechanism.coordinates[driver.inputs[at]];
        let doc = match coordinate.kind {
            Kind::Angle => format!(" For the angle `{}`: its force is a torque.", coordinate.name.text),
            Kind::Length => format!(" For the length `{}`.", coordinate.name.text),
            Kind::Number => format!(" For `{}`.", coordinate.name.text),
        };
        let (field, doc) = (field(&coordinate.name), comment(&doc));
        quote!(#[doc = #doc] pub #field: Q)
    });
    let title = comment(&format!(" One value of type `Q` for each prescribed input of [`{scene}`]."));
    Some(quote! {
        #[doc = #title]
        #derives
        #visibility struct #name<Q> { #(#members),* }
    })
}
