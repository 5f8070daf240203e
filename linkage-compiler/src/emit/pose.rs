//! The fields of a pose.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::names::{comment, ident};
use super::types::serde_of_direction;
use crate::derivation::Derivation;
use crate::graph::Texts;
use crate::model::{Driver, Guess, Mechanism};
use crate::program::{Derived, Taken};

/// The fields of a pose in a stub.
pub(super) fn guessed(mechanism: &Mechanism, driver: &Driver, root: &TokenStream) -> TokenStream {
    let mut taken = Taken::unreserved();
    let fields = Guess::pose(mechanism, driver).into_iter();
    let fields = fields.map(|(id, is_angle)| (mechanism.coordinates[id].name.field.as_str(), is_angle));
    let fields: Vec<(&str, bool)> = fields.collect();
    let names: Vec<Ident> = fields.iter().map(|(field, _)| ident(&taken.unique(field))).collect();
    let members = fields.iter().zip(&names).map(|((field, is_angle), name)| match is_angle {
        true => {
            let number = ident(&taken.unique(&format!("{field}_angle")));
            quote!(pub #name: #root::__rt::UnitComplex<T>, pub #number: T,)
        }
        false => quote!(pub #name: T,),
    });
    let members: TokenStream = members.collect();
    let scalar = ident(&taken.unique("scalar"));
    quote!(#members #scalar: ::core::marker::PhantomData<T>)
}

/// The fields of a pose.
pub(super) fn fields(
    mechanism: &Mechanism,
    derived: &Derived,
    derivation: &Derivation,
    root: &TokenStream,
) -> TokenStream {
    let checked = serde_of_direction(mechanism);
    let plan = &derived.pose;
    let mut texts = Texts::default();
    let mut members = TokenStream::new();
    let mut member = |name: &str, text: String, attribute: Option<&TokenStream>, of: TokenStream| {
        let (name, text) = (ident(name), comment(&text));
        members.extend(quote!(#[doc = #text] #attribute pub #name: #of,));
    };
    for (angle, name) in &plan.directions {
        let text = format!(" The direction of `{}`.", texts.of(&derivation.graph, *angle));
        member(name, text, checked.as_ref(), quote!(#root::__rt::UnitComplex<T>));
    }
    for (index, name, _) in &plan.values {
        member(name, format!(" The coordinate `{}`.", derivation.coordinates[*index].name), None, quote!(T));
    }
    for (node, name, _) in &plan.externals {
        member(name, format!(" `{}`.", texts.of(&derivation.graph, *node)), None, quote!(T));
    }
    for (block, name, _) in &plan.determinants {
        let block = &derivation.blocks[*block];
        let Some(determinant) = block.determinant else { continue };
        let of = match derivation.blocks.len() {
            1 => "det J".to_owned(),
            _ => format!("The determinant of the block of `{}`,", block.names(derivation).replace(", ", "`, `")),
        };
        let formula = texts.of(&derivation.graph, determinant.value);
        member(name, format!(" {of} = `{formula}`."), None, quote!(T));
    }
    members
}
