//! The fields of a pose.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::derives::serde_of_direction;
use crate::emit::names::{comment, ident};
use crate::model::{Coordinate, Driver, Kind, Mechanism};
use crate::program::{PoseField, Taken};

/// The fields of a pose in a stub: the coordinates, angles as directions and as numbers.
pub(super) fn guessed(mechanism: &Mechanism, driver: &Driver, root: &TokenStream) -> TokenStream {
    let nothing = BTreeSet::new();
    let mut taken = Taken::new(&nothing);
    let order = mechanism.coordinate_order(driver);
    let coordinates: Vec<&Coordinate> = order.iter().map(|&index| &mechanism.coordinates[index]).collect();
    let names: Vec<Ident> = coordinates.iter().map(|coordinate| ident(&taken.unique(&coordinate.name.field))).collect();
    let members = coordinates.iter().zip(&names).map(|(coordinate, name)| match coordinate.kind {
        Kind::Angle => {
            let number = ident(&taken.unique(&format!("{}_angle", coordinate.name.field)));
            quote!(pub #name: #root::__rt::UnitComplex<T>, pub #number: T,)
        }
        Kind::Length | Kind::Number => quote!(pub #name: T,),
    });
    let members: TokenStream = members.collect();
    let scalar = ident(&taken.unique("scalar"));
    quote!(#members #scalar: ::core::marker::PhantomData<T>)
}

/// The fields of a pose.
pub(super) fn fields(mechanism: &Mechanism, fields: &[PoseField], root: &TokenStream) -> TokenStream {
    let checked = serde_of_direction(mechanism);
    let members = fields.iter().map(|PoseField { name, doc, is_direction }| {
        let (name, doc) = (ident(name), comment(&format!(" {doc}")));
        match is_direction {
            true => quote!(#[doc = #doc] #checked pub #name: #root::__rt::UnitComplex<T>,),
            false => quote!(#[doc = #doc] pub #name: T,),
        }
    });
    members.collect()
}
