//! The functions of traits that convert between columns of numbers and structs with a field for each.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::ext::IdentExt;

use super::Declared;
use super::names::ident;
use super::numbers::literal;
use super::types::{field, mark};
use crate::ids::CoordinateId;
use crate::program::{SceneSignatures, Signatures, Taken, TypeNames};

/// Conversions between (u, v) and coordinates or rates by name.
pub(super) fn of_driver(of: Declared<'_>, signatures: &Signatures) -> TokenStream {
    let Declared { mechanism, driver } = of;
    let [coordinates, rates] = [&signatures.types.coordinates, &signatures.types.rates].map(|name| ident(name));
    let [u, v] = [signatures.unknowns.len(), signatures.inputs.len()].map(literal);
    let [by_unknowns, by_inputs] = [&u, &v].map(|count| quote!(__rt::Column<T, __rt::D<#count>>));
    let named = |indices: &[CoordinateId]| -> Vec<Ident> {
        indices.iter().map(|&index| field(&mechanism.coordinates[index].name)).collect()
    };
    let (unknowns, inputs) = (named(&driver.unknowns), named(&driver.inputs));
    // In the order of the fields.
    let fields = fields(of);
    let of_none = mark(&fields);
    let composed = |function: &str, of: &Ident| {
        let function = ident(function);
        quote! {
            fn #function(unknowns: #by_unknowns, inputs: #by_inputs) -> #of<T> {
                let ([#(#unknowns),*], [#(#inputs),*]): ([T; #u], [T; #v]) = (unknowns.into(), inputs.into());
                #of { #(#fields,)* #of_none }
            }
        }
    };
    let divided = |function: &str, argument: &str, of: &Ident| {
        let (function, argument) = (ident(function), ident(argument));
        quote! {
            fn #function(#argument: &#of<T>) -> (#by_unknowns, #by_inputs) {
                ([#(#argument.#unknowns),*].into(), [#(#argument.#inputs),*].into())
            }
        }
    };
    let composed = [composed("coordinates", &coordinates), composed("rates", &rates)];
    let divided = [divided("parts", "q", &coordinates), divided("rate_parts", "rates", &rates)];
    quote!(#(#composed)* #(#divided)*)
}

/// The mechanism of a scene; the state in a column, from coordinates and input rates by name, and back.
pub(super) fn of_scene(of: Declared<'_>, signatures: &SceneSignatures) -> TokenStream {
    let SceneSignatures { types, field: inner, inputs, unknowns, .. } = signatures;
    let TypeNames { inputs: inputs_type, coordinates, .. } = types;
    let [inner, inputs_type, coordinates] = [inner, inputs_type, coordinates].map(|name| ident(name));
    let count = literal(unknowns + 2 * inputs.len());
    let (fields, names) = (fields(of), inputs.iter().map(|input| ident(input)).collect::<Vec<_>>());
    // `x_rate` may be a coordinate as well.
    let reserved = fields.iter().map(|field| field.unraw().to_string()).collect();
    let mut taken = Taken::new(&reserved);
    let rates: Vec<Ident> = inputs.iter().map(|input| ident(&taken.unique(&format!("{input}_rate")))).collect();
    let (no_fields, no_inputs) = (mark(&fields), mark(&names));
    quote! {
        fn mechanism(&self) -> &Self::Mechanism {
            &self.#inner
        }
        fn state(q: &#coordinates<T>, input_rates: &#inputs_type<T>) -> __rt::Column<T, __rt::D<#count>> {
            [#(q.#fields,)* #(input_rates.#names),*].into()
        }
        fn parts(state: &__rt::Column<T, __rt::D<#count>>) -> __rt::StateParts<#coordinates<T>, #inputs_type<T>> {
            let [#(#fields,)* #(#rates),*]: [T; #count] = (*state).into();
            __rt::StateParts {
                q: #coordinates { #(#fields,)* #no_fields },
                input_rates: #inputs_type { #(#names: #rates,)* #no_inputs },
            }
        }
    }
}

/// The fields of all coordinates, in their order.
fn fields(Declared { mechanism, driver }: Declared<'_>) -> Vec<Ident> {
    mechanism.coordinate_order(driver).iter().map(|&index| field(&mechanism.coordinates[index].name)).collect()
}
