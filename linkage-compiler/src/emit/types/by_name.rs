//! Structs with a number for each coordinate.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::derives::derives;
use super::fields::{Fields, docs};
use crate::emit::names::{comment, ident};
use crate::model::{Coordinate, Kind, Mechanism, Request};
use crate::program::{Order, TypeNames};

/// The orders of derivatives with respect to time for which types of coordinates are emitted.
pub(super) fn orders(mechanism: &Mechanism) -> impl Iterator<Item = Order> {
    let has_jerks = mechanism.requests.contains(&Request::Jerk);
    Order::ALL.into_iter().filter(move |&order| order != Order::Jerk || has_jerks)
}

/// The struct of all coordinates by name, or of their derivatives with respect to time.
pub(super) fn coordinates(
    mechanism: &Mechanism,
    names: &TypeNames,
    order: Order,
    members: &[&Coordinate],
    root: &TokenStream,
) -> TokenStream {
    let [what, of_one] = match order {
        Order::Value => ["coordinates q", ""],
        Order::Rate => ["rates `q'` of the coordinates", "rate"],
        Order::Acceleration => ["accelerations `q''` of the coordinates", "acceleration"],
        Order::Jerk => ["jerks `q'''` of the coordinates", "jerk"],
    };
    let title = format!(" The {what} of [`{}`] by name.", mechanism.name);
    let docs = |coordinate: &Coordinate| match order {
        Order::Value => described(coordinate),
        _ => {
            let text = format!(" The {of_one} of `{}`{}.", coordinate.name.text, unit(coordinate.kind, order));
            let text = comment(&text);
            quote!(#[doc = #text])
        }
    };
    by_name(mechanism, &ident(order.type_of(names)), &title, members, &docs, root)
}

/// The unit of a derivative with respect to time, for a doc comment.
fn unit(of: Kind, order: Order) -> String {
    let [power, each] = match order {
        Order::Value | Order::Rate => ["", ""],
        Order::Acceleration => ["^2", " squared"],
        Order::Jerk => ["^3", " cubed"],
    };
    match of {
        Kind::Angle => format!(", in rad/s{power}"),
        Kind::Length => format!(", in the unit of lengths per second{each}"),
        Kind::Number => format!(", per second{each}"),
    }
}

/// The user's doc comment of a coordinate, or its name and kind.
pub(super) fn described(coordinate: &Coordinate) -> TokenStream {
    docs(&coordinate.attributes, &format!("`{}`: {}.", coordinate.name.text, coordinate.kind))
}

/// A struct with a number for each of some coordinates, and its conversions from and to vectors.
pub(super) fn by_name(
    mechanism: &Mechanism,
    name: &Ident,
    title: &str,
    members: &[&Coordinate],
    docs: &dyn Fn(&Coordinate) -> TokenStream,
    root: &TokenStream,
) -> TokenStream {
    let (visibility, derives, title) = (&mechanism.visibility, derives(mechanism, root), comment(title));
    let fields = Fields::of(members.iter().map(|member| &member.name));
    let (names, texts, count) = (&fields.names, &fields.texts, fields.count());
    let phantom = fields.phantom();
    let declared = members.iter().zip(names).map(|(coordinate, field)| {
        let docs = docs(coordinate);
        quote!(#docs pub #field: T)
    });
    let conversions = conversions(name, &fields, &quote!(#root::__rt::SVector<T, #count>), root);
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #name<T = f64> { #(#declared,)* #phantom }
        impl<T> #name<T> {
            #[doc = " The declared names, in the order of the fields."]
            pub const NAMES: [&'static str; #count] = [#(#texts),*];
        }
        #conversions
    }
}

/// The conversions of a struct of numbers from and to a vector.
pub(super) fn conversions(name: &Ident, fields: &Fields, vector: &TokenStream, root: &TokenStream) -> TokenStream {
    let (names, count, mark) = (&fields.names, fields.count(), fields.mark());
    quote! {
        impl<T: #root::__rt::Real> ::core::convert::From<#vector> for #name<T> {
            fn from(vector: #vector) -> Self {
                let [#(#names),*] = <[T; #count] as ::core::convert::From<#vector>>::from(vector);
                Self { #(#names,)* #mark }
            }
        }
        impl<T: #root::__rt::Real> ::core::convert::From<#name<T>> for #vector {
            fn from(by_name: #name<T>) -> Self {
                <Self as ::core::convert::From<[T; #count]>>::from([#(by_name.#names),*])
            }
        }
    }
}
