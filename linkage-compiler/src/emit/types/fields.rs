//! The fields of structs, and their doc comments.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::Attribute;

use crate::emit::names::comment;
use crate::emit::numbers::literal;
use crate::emit::rust;
use crate::model::Name;

/// A field name with the user's span, so that editors link the field to its declaration.
pub(in crate::emit) fn field(name: &Name) -> Ident {
    name.identifier(proc_macro2::Span::call_site().located_at(name.span))
}

/// The user's doc comment, or `text` if there is none.
pub(in crate::emit) fn docs(attributes: &[Attribute], text: &str) -> TokenStream {
    let own: Vec<&Attribute> = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).collect();
    if own.is_empty() {
        let text = comment(&format!(" {text}"));
        quote!(#[doc = #text])
    } else {
        quote!(#(#own)*)
    }
}

/// The fields of a struct, all of type `T`; a struct without fields has a `PhantomData<T>`.
pub(super) struct Fields<'a> {
    pub(super) names: Vec<Ident>,
    pub(super) texts: Vec<&'a str>,
}

impl<'a> Fields<'a> {
    pub(super) fn of(names: impl Iterator<Item = &'a Name>) -> Self {
        let (names, texts) = names.map(|name| (field(name), name.text.as_str())).unzip();
        Self { names, texts }
    }

    /// The name of an argument, with an underscore if there are no fields to use it.
    pub(super) fn argument(&self, name: &str) -> Ident {
        rust::argument(name, !self.names.is_empty())
    }

    pub(super) fn count(&self) -> Literal {
        literal(self.names.len())
    }

    /// The declaration of the `PhantomData` field.
    pub(super) fn phantom(&self) -> Option<TokenStream> {
        self.names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<T>))
    }

    /// The value of the `PhantomData` field.
    pub(super) fn mark(&self) -> Option<TokenStream> {
        mark(&self.names)
    }
}

/// The value of the `PhantomData` field of a struct with these fields.
pub(in crate::emit) fn mark(names: &[Ident]) -> Option<TokenStream> {
    names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData))
}
