//! Implementations of the runtime's trait for scenes, by which simulations call emitted functions.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::ext::IdentExt;

use super::names::{ident, string};
use super::rust::{argument, literal};
use super::traits::Members;
use super::types::mark;
use crate::derivation::Kink;
use crate::model::Driver;
use crate::program::{SceneSignatures, Taken, TypeNames};

/// Implements `Scene` if the scene has `inertia`.
pub(super) fn of_scene(
    signatures: &SceneSignatures,
    on: &Driver,
    (fields, kinks): (&[Ident], &[Kink]),
) -> Option<TokenStream> {
    let SceneSignatures { scene, types, field: inner, inputs, driven, unknowns, .. } = signatures;
    scene.inertia.as_ref()?;
    let (name, text) = (&scene.name, scene.name.to_string());
    let TypeNames { driver, inputs: inputs_type, coordinates, rates, .. } = types;
    let [of, inputs_type, coordinates, rates] = [driver, inputs_type, coordinates, rates].map(|n| ident(n));
    let inner = ident(inner);
    let unknowns = *unknowns;
    let [u, v, n, c] = [unknowns, inputs.len(), unknowns + 2 * inputs.len(), scene.contacts.len()].map(literal);
    let names: Vec<Ident> = inputs.iter().map(|input| ident(input)).collect();
    // `x_rate` may be a coordinate as well.
    let fields_as_text = fields.iter().map(|field| field.unraw().to_string()).collect();
    let mut taken = Taken::new(&fields_as_text);
    let input_rates: Vec<Ident> = inputs.iter().map(|input| ident(&taken.unique(&format!("{input}_rate")))).collect();
    let prescribed = inputs.ids().map(|at| match driven.contains(&at) {
        true => {
            let driven = ident(&inputs[at]);
            quote!(__rt::Some(drives.#driven))
        }
        false => quote!(__rt::None),
    });
    let prescribed: Vec<TokenStream> = prescribed.collect();
    let (no_fields, no_inputs) = (mark(fields), mark(&names));
    let (time, drives) = match driven.is_empty() {
        true => (quote!(_t), TokenStream::new()),
        false => (quote!(t), quote!(let drives = self.drives(t);)),
    };
    let has_contacts = !scene.contacts.is_empty();
    let equations = match has_contacts {
        false => quote! {
            __rt::Equations::at(
                &self.#inner, &q, input_rates, self.mass_matrix(&q)?, self.forces(t, &q, input_rates)?
            )
        },
        true => quote!(self.equations(t, &q, input_rates)),
    };
    let [of_t, of_q, of_rates] = ["t", "q", "rates"].map(|name| argument(name, has_contacts));
    let contacts = match has_contacts {
        false => quote!(__rt::Ok([].into())),
        true => quote!(__rt::Ok(self.contacts(t, q, rates)?.into())),
    };
    let state = quote!(__rt::Column<T, __rt::D<#n>>);
    let (reactions, joints) = reactions(signatures, on, fields);
    let bearings = bearings(signatures);
    let kinks = of_kinks(signatures, kinks);
    let result = |of: TokenStream| quote!(__rt::Result<#of, __rt::MotionError>);
    let (nothing, derivative) = (result(quote!(())), result(state.clone()));
    let [all_contacts, all_equations, all_unreduced] = [
        quote!(__rt::Column<__rt::Contact<T, __rt::D<#u>, __rt::D<#v>>, __rt::D<#c>>),
        quote!(__rt::Equations<T, __rt::D<#u>, __rt::D<#v>>),
        quote!(__rt::Unreduced<T, __rt::D<#u>, __rt::D<#v>>),
    ]
    .map(result);
    Some(quote! {
        impl<T: __rt::Real> __rt::Scene for #name<T> {
            type Scalar = T;
            type U = __rt::D<#u>;
            type V = __rt::D<#v>;
            type State = __rt::D<#n>;
            type Contacts = __rt::D<#c>;
            type Mechanism = #of<T>;
            type Reactions = #reactions;
            const NAME: &'static str = #text;
            fn mechanism(&self) -> &Self::Mechanism {
                &self.#inner
            }
            fn state(q: &#coordinates<T>, input_rates: &#inputs_type<T>) -> #state {
                [#(q.#fields,)* #(input_rates.#names),*].into()
            }
            fn parts(state: &#state) -> __rt::StateParts<#coordinates<T>, #inputs_type<T>> {
                let [#(#fields,)* #(#input_rates),*]: [T; #n] = (*state).into();
                __rt::StateParts {
                    q: #coordinates { #(#fields,)* #no_fields },
                    input_rates: #inputs_type { #(#names: #input_rates,)* #no_inputs },
                }
            }
            fn check(&self) -> #nothing {
                self.check()
            }
            fn derivative(&self, t: T, state: &#state) -> #derivative {
                let __rt::StateParts { q, input_rates } = Self::parts(state);
                let __rt::StateRates { rates, input_accelerations } = self.rates(t, &q, input_rates)?;
                __rt::Ok([#(rates.#fields,)* #(input_accelerations.#names),*].into())
            }
            fn equations(&self, t: T, state: &#state) -> #all_equations {
                let __rt::StateParts { q, input_rates } = Self::parts(state);
                #equations
            }
            fn contacts(&self, #of_t: T, #of_q: &#coordinates<T>, #of_rates: &#rates<T>) -> #all_contacts {
                #contacts
            }
            #joints
            #bearings
            #kinks
            fn unreduced(&self, t: T, q: &#coordinates<T>, rates: &#rates<T>) -> #all_unreduced {
                self.unreduced(t, q, rates)
            }
            fn prescribed(&self, #time: T) -> __rt::Column<__rt::Option<__rt::Prescribed<T>>, __rt::D<#v>> {
                #drives
                [#(#prescribed),*].into()
            }
        }
    })
}

/// The type of the forces in the joints of a scene, and the function of `Scene` that computes them.
fn reactions(signatures: &SceneSignatures, driver: &Driver, fields: &[Ident]) -> (TokenStream, TokenStream) {
    let SceneSignatures { mechanism, scene, types, reactions_type, inputs, unknowns, .. } = signatures;
    let TypeNames { coordinates, rates, accelerations, .. } = types;
    let [name, coordinates, rates, accelerations] =
        [reactions_type, coordinates, rates, accelerations].map(|name| ident(name));
    let [u, v, c] = [*unknowns, inputs.len(), scene.contacts.len()].map(literal);
    let has_reactions = signatures.has_reactions();
    let of = if has_reactions { quote!(#name<T>) } else { quote!(()) };
    let names = ["t", "q", "rates", "accelerations", "contact_forces"];
    let [t, q, of_rates, of_accelerations, forces] =
        names.map(|name| argument(name, has_reactions && (name != "contact_forces" || !scene.contacts.is_empty())));
    let no_fields = mark(fields);
    let value = if has_reactions {
        let unknowns = Members::of(mechanism, &driver.unknowns).fields;
        let inputs = Members::of(mechanism, &driver.inputs).fields;
        let forces = (!scene.contacts.is_empty()).then(|| quote!(&(*contact_forces).into()));
        quote! {
            // Its own block: a coordinate may have the name of an argument.
            let accelerations = {
                let ([#(#unknowns),*], [#(#inputs),*]): ([T; #u], [T; #v]) =
                    (accelerations.unknowns.into(), accelerations.inputs.into());
                #accelerations { #(#fields,)* #no_fields }
            };
            self.reactions_of(t, q, rates, &accelerations, #forces)
        }
    } else {
        quote!(__rt::Ok(()))
    };
    let function = quote! {
        fn reactions(
            &self,
            #t: T,
            #q: &#coordinates<T>,
            #of_rates: &#rates<T>,
            #of_accelerations: &__rt::Vector<T, __rt::D<#u>, __rt::D<#v>>,
            #forces: &__rt::Column<T, __rt::D<#c>>,
        ) -> __rt::Result<Self::Reactions, __rt::MotionError> {
            #value
        }
    };
    (of, function)
}

/// The constant and the function of `Scene` for the kinks of its laws, if there are any.
fn of_kinks(signatures: &SceneSignatures, kinks: &[Kink]) -> Option<TokenStream> {
    let [coordinates, rates] = [&signatures.types.coordinates, &signatures.types.rates].map(|name| ident(name));
    let all = kinks.iter().map(|Kink { label, is_timed, .. }| {
        let effect = string(label);
        quote!(__rt::Kink { effect: #effect, is_timed: #is_timed })
    });
    let all: Vec<TokenStream> = all.collect();
    (!kinks.is_empty()).then(|| {
        quote! {
            const KINKS: &'static [__rt::Kink] = &[#(#all),*];
            fn kink(&self, place: usize, t: T, q: &#coordinates<T>, rates: &#rates<T>) -> T {
                self.kinks(t, q, rates).get(place).copied().unwrap_or(T::one())
            }
        }
    })
}

/// The constant and the function of `Scene` for the reactions that limit frictions, if there are any.
fn bearings(signatures: &SceneSignatures) -> Option<TokenStream> {
    let SceneSignatures { scene, types, inputs, unknowns, .. } = signatures;
    let [coordinates, rates] = [&types.coordinates, &types.rates].map(|name| ident(name));
    let [u, v, c] = [*unknowns, inputs.len(), scene.contacts.len()].map(literal);
    let count = signatures.count_bearings();
    let names: Vec<Ident> = (1..=count).map(|number| ident(&format!("bearing_{number}"))).collect();
    let mut left = names.iter();
    let all = scene.contacts.iter().map(|contact| match contact.bearing.and_then(|_| left.next()) {
        Some(name) => quote!(__rt::Some(#name)),
        None => quote!(__rt::None),
    });
    let all: Vec<TokenStream> = all.collect();
    let bearing = quote!(__rt::Bearing<T, __rt::D<#u>, __rt::D<#v>, __rt::D<#c>>);
    (count > 0).then(|| {
        quote! {
            const BEARINGS: bool = true;
            fn bearings(
                &self,
                t: T,
                q: &#coordinates<T>,
                rates: &#rates<T>,
            ) -> __rt::Result<__rt::Column<__rt::Option<#bearing>, __rt::D<#c>>, __rt::MotionError> {
                let [#(#names),*] = self.bearings(t, q, rates)?;
                __rt::Ok([#(#all),*].into())
            }
        }
    })
}
