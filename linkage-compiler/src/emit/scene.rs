//! The type of a scene: the mechanism, and the parameters of the effects that the scene names.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::Attribute;

use super::names::ident;
use super::numbers::literal;
use super::types::{MOST_ARGUMENTS, default_of, docs, docs_of_parameter, field, other_scalar, serde_of_parameters};
use crate::model::{Mechanism, Parameter};
use crate::program::SceneSignatures;

pub(super) fn types(mechanism: &Mechanism, signatures: &SceneSignatures, root: &TokenStream) -> TokenStream {
    let scene = &mechanism.scenes[signatures.id];
    let (visibility, name, of) = (&mechanism.visibility, &scene.name, &mechanism.drivers[scene.driver].name);
    let (inner, other_scalar) = (ident(&signatures.field), other_scalar(mechanism));
    let parameters: Vec<&Parameter> = scene.parameters.iter().map(|&span| &mechanism.scene_parameters[span]).collect();
    let fields: Vec<Ident> = parameters.iter().map(|parameter| field(&parameter.name)).collect();
    let members = parameters.iter().zip(&fields).map(|(parameter, field)| {
        let docs = docs_of_parameter(mechanism, parameter);
        let other = parameter.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        quote!(#docs #(#other)* pub #field: T)
    });
    let title = docs(&scene.attributes, &format!("[`{of}`] with the effects of the scene `{name}`."));
    let forwarded = scene.attributes.iter().chain(&mechanism.attributes);
    let forwarded: Vec<&Attribute> = forwarded.filter(|attribute| !attribute.path().is_ident("doc")).collect();
    let serde = serde_of_parameters(mechanism, &forwarded, root);
    let count = literal(fields.len());
    let texts: Vec<&String> = parameters.iter().map(|parameter| &parameter.name.text).collect();
    let new = (fields.len() < MOST_ARGUMENTS).then(|| {
        quote! {
            #[doc = " A scene with this mechanism and these parameters of the effects."]
            #[must_use]
            pub const fn new(#inner: #of<T>, #(#fields: T),*) -> Self {
                Self { #inner, #(#fields),* }
            }
        }
    });
    let all = parameters.iter().map(|parameter| default_of(mechanism, parameter)).collect::<Option<Vec<_>>>();
    let has_default = mechanism.parameters.iter().all(|parameter| parameter.default.is_some());
    let defaults = all.filter(|_| has_default).map(|defaults| {
        quote! {
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self { #inner: <#of as ::core::default::Default>::default(), #(#fields: #defaults),* }
                }
            }
        }
    });
    quote! {
        #title
        #(#forwarded)*
        #serde
        #visibility struct #name<T = f64> {
            #[doc = " The mechanism, with the kinematics."]
            pub #inner: #of<T>,
            #(#members),*
        }
        impl<T> ::core::convert::From<(#of<T>, [T; #count])> for #name<T> {
            fn from((#inner, [#(#fields),*]): (#of<T>, [T; #count])) -> Self {
                Self { #inner, #(#fields),* }
            }
        }
        impl<T: #root::__rt::Real> #name<T> {
            #[doc = " The declared names of the parameters of the effects, in order."]
            pub const PARAMETERS: [&'static str; #count] = [#(#texts),*];
            #new
            #[doc = " This scene with another scalar type: applies a function to each parameter."]
            #[must_use]
            pub fn map<#other_scalar: #root::__rt::Real>(
                self,
                scalar: impl ::core::ops::Fn(T) -> #other_scalar,
            ) -> #name<#other_scalar> {
                #name { #(#fields: scalar(self.#fields),)* #inner: self.#inner.map(scalar) }
            }
        }
        #defaults
    }
}
