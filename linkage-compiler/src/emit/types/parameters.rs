//! The type of the parameters of a mechanism.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::Attribute;

use super::derives::serde_of_parameters;
use super::fields::{Fields, docs};
use crate::emit::names::{comment, ident};
use crate::emit::numbers;
use crate::graph::Number;
use crate::model::{Mechanism, Parameter, TypeName};

/// `new` is emitted only up to this number of parameters; longer argument lists are hard to read at the call.
pub const MOST_ARGUMENTS: usize = 7;

/// The type of the parameters, with its functions.
pub(super) fn parameters(
    mechanism: &Mechanism,
    name: &TypeName,
    attributes: &[Attribute],
    note: Option<TokenStream>,
    root: &TokenStream,
) -> TokenStream {
    let visibility = &mechanism.visibility;
    let fields = Fields::of(mechanism.parameters.iter().map(|parameter| &parameter.name));
    let (names, texts, count) = (&fields.names, &fields.texts, fields.count());
    let (phantom, mark, other) = (fields.phantom(), fields.mark(), other_scalar(mechanism));
    let [all, scalar] = ["parameters", "scalar"].map(|name| fields.argument(name));
    let members = mechanism.parameters.iter().zip(names).map(|(parameter, field)| {
        let docs = docs_of_parameter(mechanism, parameter);
        let other = parameter.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        quote!(#docs #(#other)* pub #field: T)
    });
    let own_docs = attributes.iter().any(|attribute| attribute.path().is_ident("doc"));
    let title = (!own_docs).then(|| {
        let text = comment(&format!(" The parameters of the mechanism `{name}`."));
        quote!(#[doc = #text])
    });
    let new = (names.len() <= MOST_ARGUMENTS).then(|| {
        quote! {
            #[doc = " A mechanism with these parameters."]
            #[must_use]
            pub const fn new(#(#names: T),*) -> Self {
                Self { #(#names,)* #mark }
            }
        }
    });
    let defaults = mechanism.parameters.iter().map(|parameter| default_of(mechanism, parameter));
    let default = defaults.collect::<Option<Vec<_>>>().map(|defaults| {
        quote! {
            // For `f64` only, so that type inference needs no annotation.
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self { #(#names: #defaults,)* #mark }
                }
            }
        }
    });
    let serde = serde_of_parameters(mechanism, &attributes.iter().collect::<Vec<_>>(), root);
    quote! {
        #title
        #(#attributes)*
        #note
        #serde
        #visibility struct #name<T = f64> { #(#members,)* #phantom }
        impl<T> ::core::convert::From<[T; #count]> for #name<T> {
            fn from([#(#names),*]: [T; #count]) -> Self {
                Self { #(#names,)* #mark }
            }
        }
        impl<T> ::core::convert::From<#name<T>> for [T; #count] {
            fn from(#all: #name<T>) -> Self {
                [#(#all.#names),*]
            }
        }
        impl<T: #root::__rt::Real> #name<T> {
            #[doc = " The declared names of the parameters, in order."]
            pub const PARAMETERS: [&'static str; #count] = [#(#texts),*];
            #new
            #[doc = " This mechanism with another scalar type: applies a function to each parameter."]
            #[must_use]
            pub fn map<#other>(self, #scalar: impl ::core::ops::Fn(T) -> #other) -> #name<#other> {
                #name { #(#names: #scalar(self.#names),)* #mark }
            }
        }
        #default
    }
}

/// The user's doc comment of a parameter, or its name and quantity; then its default.
pub(in crate::emit) fn docs_of_parameter(mechanism: &Mechanism, parameter: &Parameter) -> TokenStream {
    let docs = docs(&parameter.attributes, &format!("`{}`: {}.", parameter.name.text, parameter.measure));
    let default = parameter.default.map(|default| {
        let written = parameter.default_in_words().unwrap_or_else(|| mechanism.graph.text(default));
        let text = comment(&format!(" Default: {written}."));
        quote!(#[doc = ""] #[doc = #text])
    });
    quote!(#docs #default)
}

/// The default value of a parameter as an `f64`.
pub(in crate::emit) fn default_of(mechanism: &Mechanism, parameter: &Parameter) -> Option<TokenStream> {
    let node = parameter.default?;
    let graph = &mechanism.graph;
    let number = graph.as_number(node).or_else(|| graph.constant_value(node).map(Number::Float))?;
    Some(numbers::plain(number))
}

/// The name of a second scalar type parameter; it differs from all types of the user.
pub(in crate::emit) fn other_scalar(mechanism: &Mechanism) -> Ident {
    let scenes = mechanism.scenes.iter().map(|scene| &scene.name);
    let types: Vec<&TypeName> = mechanism.drivers.iter().map(|driver| &driver.name).chain(scenes).collect();
    let mut name = "S".to_owned();
    while types.iter().any(|taken| **taken == *name) || mechanism.name == *name {
        name.push('S');
    }
    ident(&name)
}
