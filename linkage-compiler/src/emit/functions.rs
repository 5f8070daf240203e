//! Functions of a program as Rust.

use linkage_ir::code::{Code, Names, Returned};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};

use super::names::comment;
use super::printer::Printer;
use super::rust::{Rust, argument, tokens};
use super::spans;
use crate::program::{Access, Argument, Function, Operations, Passed, Type, count};
use crate::syntax::identifier;

/// Emits a function with its doc comment, at a place; `error` is its error type. Without a body it is a stub.
pub(super) fn function(
    function: &Function<Code>,
    names: &Names,
    error: &Ident,
    generics: Option<TokenStream>,
    span: Span,
) -> TokenStream {
    let Function { name, doc, access, is_method, arguments, returns, is_fallible, body } = function;
    // Only functions that others call show their operation counts.
    let readable = body.as_ref().map(|code| &code.readable);
    let cost = readable.filter(|_| access.is_public() || *access == Access::OfTrait).map(|of| of.operations);
    let bound = readable.and_then(|of| of.accuracy.clone());
    // A trait documents its functions.
    let is_shown = !matches!(access, Access::OfTrait | Access::OfMechanism | Access::Lane) || !doc.is_empty();
    let doc = is_shown.then(|| {
        // The documentation of a binary has private functions too.
        if access.is_private() {
            return quote!(#[doc(hidden)]);
        }
        let text = comment(&description(doc, cost.unwrap_or_default(), bound));
        quote!(#[doc = #text])
    });
    let name = identifier(name, span);
    let itself = is_method.then(|| quote!(&self));
    let arguments = arguments.iter().enumerate().map(|(index, Argument { name, passed })| {
        let name = argument(name, readable.is_some_and(|of| of.uses.contains(&index)));
        let (of, passed) = match passed {
            Passed::ByValue(of) => (tokens(of), quote!()),
            Passed::ByReference(of) => (tokens(of), quote!(&)),
            Passed::ByMutableReference(of) => (tokens(of), quote!(&mut)),
            Passed::Converted(of) => {
                let of = tokens(of);
                (quote!(impl __rt::Into<#of>), quote!())
            }
            Passed::Turns => (quote!(&impl __rt::Turn<T>), quote!()),
        };
        quote!(#name: #passed #of)
    });
    let arguments = itself.into_iter().chain(arguments);
    let is_iterator = matches!(returns, Type::Branches { .. } | Type::Iterator { .. });
    let attributes = match access {
        // An iterator must be used anyway.
        Access::Public if !is_fallible && !is_iterator => quote!(#[must_use] pub),
        Access::Public => quote!(pub),
        Access::PublicInlined if !is_fallible => quote!(#[inline] #[must_use] pub),
        Access::PublicInlined => quote!(#[inline] pub),
        Access::Hidden if !is_fallible => quote!(#[doc(hidden)] #[must_use] pub),
        Access::Hidden => quote!(#[doc(hidden)] pub),
        Access::Deprecated => {
            let sentences: Vec<&str> =
                function.doc.iter().map(String::as_str).take_while(|line| !line.is_empty()).collect();
            let note = super::names::string(&sentences.join(" "));
            quote!(#[deprecated(note = #note)] pub)
        }
        Access::PublicLayer => quote!(#[inline(always)] #[must_use] pub),
        Access::Inlined | Access::LaneAlone => quote!(#[inline]),
        Access::Layer | Access::Lane => quote!(#[inline(always)]),
        Access::Cold => quote!(#[cold]),
        Access::OfTrait | Access::OfMechanism => TokenStream::new(),
    };
    let body = match body {
        Some(code) => {
            let printer = Printer { code, names, style: Rust };
            let (statements, value) = (printer.statements(&code.statements), printer.value(code.value.returned()));
            let value = match code.value {
                Returned::Plain(_) if *is_fallible => quote!(__rt::Ok(#value)),
                _ => value,
            };
            quote!(#(#statements)* #value)
        }
        // `!` does not implement `Iterator`, so that a stub returns an empty one.
        None if is_iterator && *is_fallible => quote!(__rt::Ok(::core::iter::empty())),
        None if is_iterator => quote!(::core::iter::empty()),
        None => quote!(::core::unreachable!()),
    };
    let returns = tokens(returns);
    let result = if *is_fallible { quote!(__rt::Result<#returns, __rt::#error>) } else { quote!(#returns) };
    let attributes = spans::located(attributes, span, 0);
    quote_spanned! {span=>
        #doc
        #attributes fn #name #generics(#(#arguments),*) -> #result { #body }
    }
}

/// The doc comment: the lines, the numbers of operations, and how large the rounding errors can be, if that is known.
fn description(lines: &[String], cost: Operations, bound: Option<String>) -> String {
    let mut lines: Vec<String> = lines.to_vec();
    if cost != Operations::default() {
        lines.extend([String::new(), format!("Operations: {}.", count(cost))]);
    }
    if let Some(bound) = bound {
        lines.extend([String::new(), bound]);
    }
    let lines = lines.iter().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") });
    lines.collect::<Vec<_>>().join("\n")
}
