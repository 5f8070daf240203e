//! The derived traits of the types.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::Attribute;

use crate::emit::names::ident;
use crate::model::{Mechanism, Request};

/// `#[derive(..)]` for types of plain data.
pub(in crate::emit) fn derives(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let serde = serde(mechanism, root);
    quote! {
        #[derive(
            ::core::clone::Clone,
            ::core::marker::Copy,
            ::core::fmt::Debug,
            ::core::cmp::PartialEq,
            ::core::cmp::Eq,
        )]
        #serde
    }
}

/// `Serialize` and `Deserialize` on request.
fn serde(mechanism: &Mechanism, root: &TokenStream) -> Option<TokenStream> {
    let path = serde_alias(mechanism).to_string();
    mechanism.requests.contains(&Request::Serde).then(|| {
        quote! {
            #[derive(#root::__rt::serde::Serialize, #root::__rt::serde::Deserialize)]
            #[serde(crate = #path)]
        }
    })
}

/// `#[derive(..)]` for types that hold a pose.
pub(in crate::emit) fn derives_of_pose(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    // The functions that read a direction compute with its numbers.
    let alias = serde_alias(mechanism);
    let bound = format!("T: {alias}::Real + {alias}::Deserialize<'de>");
    let serde = serde(mechanism, root).map(|serde| quote!(#serde #[serde(bound(deserialize = #bound))]));
    quote! {
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #serde
    }
}

/// The check of a direction that is read, on request.
pub(in crate::emit) fn serde_of_direction(mechanism: &Mechanism) -> Option<TokenStream> {
    let read = format!("{}::direction", serde_alias(mechanism));
    mechanism.requests.contains(&Request::Serde).then(|| quote!(#[serde(deserialize_with = #read)]))
}

/// `Serialize` and `Deserialize` of parameters on request, unless the user derives them.
pub(in crate::emit) fn serde_of_parameters(
    mechanism: &Mechanism,
    attributes: &[&Attribute],
    root: &TokenStream,
) -> Option<TokenStream> {
    let is_own = attributes.iter().any(|attribute| attribute.meta.to_token_stream().to_string().contains("Serialize"));
    serde(mechanism, root).filter(|_| !is_own)
}

/// The name of the crate `serde` next to the types: its derives take a path as text, which `$crate` cannot be.
pub(super) fn serde_alias(mechanism: &Mechanism) -> Ident {
    ident(&format!("__{}_serde", mechanism.name))
}
