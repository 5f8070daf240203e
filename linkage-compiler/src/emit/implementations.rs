//! Functions of types besides the main ones, and implementations of traits of the runtime.

use linkage_ir::code::{Code, Names};
use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};

use super::functions;
use super::names::{ident, string};
use super::numbers::literal;
use super::rust::tokens;
use crate::model::TypeName;
use crate::program::{Associated, ConstantValue, Group, Implementation, Implemented, Kink, Part};

/// Emits an implementation. `owner` is the driver or the scene, `first` are functions of the trait that come first.
pub(super) fn implementation(
    implementation: &Implementation<Code>,
    names: &Names,
    owner: &TypeName,
    first: Option<TokenStream>,
    span: Span,
) -> TokenStream {
    let Implementation { of, on, is_generic, error, types, constants, functions } = implementation;
    let on = if *owner == **on { owner.to_token_stream() } else { ident(on).to_token_stream() };
    let error = ident(error);
    let functions = functions.iter().map(|function| {
        let generics = generics(*of, &function.name);
        functions::function(function, names, &error, generics, span)
    });
    let implemented = of.name().map(|name| {
        let name = ident(name);
        quote!(__rt::#name for)
    });
    let types = types.iter().map(|(name, is)| associated(name, is));
    let constants = constants.iter().map(|(name, value)| constant(name, value));
    let (over, scalar) = if *is_generic { (quote!(<T: __rt::Real>), quote!(<T>)) } else { Default::default() };
    quote! {
        impl #over #implemented #on #scalar {
            #(#types)*
            #(#constants)*
            #first
            #(#functions)*
        }
    }
}

/// The constant arguments of a function: the number of lanes, and true if angles, points and outputs are wanted.
fn generics(of: Implemented, function: &str) -> Option<TokenStream> {
    match (of, function) {
        (Implemented::Lanes, "lane") => Some(quote!(<const W: usize, const QUANTITIES: bool>)),
        (Implemented::Lanes, "exact") => Some(quote!(<const QUANTITIES: bool>)),
        _ => None,
    }
}

fn associated(name: &str, is: &Associated) -> TokenStream {
    let name = ident(name);
    match is {
        Associated::Type(of) => {
            let of = tokens(of);
            quote!(type #name = #of;)
        }
        Associated::Text => quote!(type #name = &'static str;),
        Associated::Dimension(count) => {
            let count = literal(*count);
            quote!(type #name = __rt::D<#count>;)
        }
        Associated::PerQuantity(of) => {
            let of = match of.as_deref().map(ident) {
                Some(of) => quote!(#of<Q>),
                None => quote!([Q; 0]),
            };
            quote!(type #name<Q: __rt::Quantity> = #of;)
        }
    }
}

fn constant(name: &str, value: &ConstantValue) -> TokenStream {
    let name = ident(name);
    let (of, value) = match value {
        ConstantValue::Own => (quote!(&'static str), quote!(Self::#name)),
        ConstantValue::Flag(value) => (quote!(bool), quote!(#value)),
        ConstantValue::Count(count) => (quote!(usize), literal(*count).into_token_stream()),
        ConstantValue::Text(text) => (quote!(&'static str), quote!(#text)),
        ConstantValue::Texts(texts) => listed(&quote!(&'static str), texts.iter()),
        ConstantValue::Flags(flags) => listed(&quote!(bool), flags.iter()),
        ConstantValue::Groups(groups) => listed(&quote!(__rt::Group<'static>), groups.iter().map(group)),
        ConstantValue::Kinks(kinks) => listed(&quote!(__rt::Kink), kinks.iter().map(kink)),
        ConstantValue::Parts(parts) => listed(&quote!(__rt::Part<'static>), parts.iter().map(part)),
    };
    quote!(const #name: #of = #value;)
}

/// A list with entries of a type.
fn listed(of: &TokenStream, values: impl Iterator<Item = impl ToTokens>) -> (TokenStream, TokenStream) {
    (quote!(&'static [#of]), quote!(&[#(#values),*]))
}

fn group(group: &Group) -> TokenStream {
    let name = string(&group.name);
    let [equations, unknowns] = [&group.equations, &group.unknowns].map(|all| all.iter().map(|&one| literal(one)));
    quote!(__rt::Group { name: #name, equations: &[#(#equations),*], unknowns: &[#(#unknowns),*] })
}

fn kink(Kink { effect, is_timed }: &Kink) -> TokenStream {
    let effect = string(effect);
    quote!(__rt::Kink { effect: #effect, is_timed: #is_timed })
}

/// A part of a drawing.
fn part(part: &Part) -> TokenStream {
    let one = |kind: &str, joint: &usize| {
        let (kind, joint) = (ident(kind), literal(*joint));
        quote!(__rt::Part::#kind(#joint))
    };
    match part {
        Part::Ground(joint) => one("Ground", joint),
        Part::Slider(joint) => one("Slider", joint),
        Part::Trace(joint) => one("Trace", joint),
        Part::Bar { joints, is_driven } => {
            let joints = joints.iter().map(|&joint| literal(joint));
            quote!(__rt::Part::Bar { joints: &[#(#joints),*], is_driven: #is_driven })
        }
        Part::Sleeve { pin, on, towards } => {
            let [pin, on] = [pin, on].map(|&joint| literal(joint));
            let towards = match towards.map(literal) {
                Some(joint) => quote!(__rt::Some(#joint)),
                None => quote!(__rt::None),
            };
            quote!(__rt::Part::Sleeve { pin: #pin, on: #on, towards: #towards })
        }
    }
}
