//! The types of a mechanism: parameters, coordinates and their derivatives, inputs, points, outputs, pose, motion,
//! branch.

mod branch;
mod by_name;
mod derives;
mod fields;
mod motion;
mod parameters;
mod pose;

use linkage_ir::code::Code;
use proc_macro2::TokenStream;
use quote::quote;
use syn::Attribute;

use super::Declared;
use super::names::{comment, ident};
use crate::model::{Coordinate, Guess, Mechanism, Request, TypeName};
use crate::program::{Modes, Position, Program, type_names};
use branch::branch;
use by_name::{by_name, conversions, coordinates, described, orders};
use derives::{derives_of_pose, serde_alias};
use fields::Fields;
use parameters::parameters;

pub(super) use derives::{derives, serde_of_parameters};
pub(super) use fields::{docs, field, mark};
pub use parameters::MOST_ARGUMENTS;
pub(super) use parameters::{default_of, docs_of_parameter, other_scalar};

/// The types that all drivers of a mechanism share.
pub(super) fn shared(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let (visibility, name, derives) = (&mechanism.visibility, &mechanism.name, derives(mechanism, root));
    let mut tokens = TokenStream::new();
    if mechanism.requests.contains(&Request::Serde) {
        let alias = serde_alias(mechanism);
        tokens.extend(quote!(use #root::__rt::serde as #alias;));
    }
    if mechanism.is_driven_by_choice() {
        tokens.extend(parameters(mechanism, name, &mechanism.attributes, None, root));
        for driver in &mechanism.drivers {
            let other = &driver.name;
            let fields = Fields::of(mechanism.parameters.iter().map(|parameter| &parameter.name));
            let (names, mark) = (&fields.names, fields.mark());
            for (from, to) in [(name, other), (other, name)] {
                tokens.extend(quote! {
                    impl<T> ::core::convert::From<#from<T>> for #to<T> {
                        fn from(parameters: #from<T>) -> Self {
                            let #from { #(#names,)* .. } = parameters;
                            Self { #(#names,)* #mark }
                        }
                    }
                });
            }
        }
    }
    let names = mechanism.drivers.first().map(|driver| type_names(mechanism, driver));
    let Some(names) = names else { return tokens };
    let order = mechanism.drivers.first().map(|driver| mechanism.coordinate_order(driver)).unwrap_or_default();
    let members: Vec<&Coordinate> = order.iter().map(|&index| &mechanism.coordinates[index]).collect();
    for order in orders(mechanism) {
        tokens.extend(coordinates(mechanism, &names, order, &members, root));
    }
    let points = mechanism.points.iter().map(|point| (&point.name, point.attributes.as_slice()));
    let outputs = mechanism.outputs.iter().map(|output| (&output.name, output.attributes.as_slice()));
    for (group, what, members) in
        [(&names.points, "points", points.collect::<Vec<_>>()), (&names.outputs, "outputs", outputs.collect())]
    {
        if members.is_empty() {
            continue;
        }
        let (group, kind) = (ident(group), &what[..what.len() - 1]);
        let fields = Fields::of(members.iter().map(|(name, _)| *name));
        let (fields, texts, count) = (&fields.names, &fields.texts, fields.count());
        let declared = members.iter().zip(fields).map(|((name, attributes), field)| {
            let docs = docs(attributes, &format!("The {kind} `{}`.", name.text));
            quote!(#docs pub #field: Q)
        });
        let title = comment(&format!(" One value of type `Q` for each of the {what} of [`{name}`]."));
        tokens.extend(quote! {
            #[doc = #title]
            #derives
            #visibility struct #group<Q> { #(#declared),* }
            impl<Q> #group<Q> {
                #[doc = " The declared names, in order."]
                pub const NAMES: [&'static str; #count] = [#(#texts),*];
            }
            impl<Q> ::core::convert::From<#group<Q>> for [Q; #count] {
                fn from(named: #group<Q>) -> Self {
                    [#(named.#fields),*]
                }
            }
            impl<Q> ::core::convert::From<[Q; #count]> for #group<Q> {
                fn from([#(#fields),*]: [Q; #count]) -> Self {
                    Self { #(#fields),* }
                }
            }
        });
    }
    tokens
}

/// The types of one driver: parameters, inputs, pose, motion, branch.
pub(super) fn of_driver(of: Declared<'_>, program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let Declared { mechanism, driver } = of;
    let (name, types, visibility) = (&driver.name, &program.signatures.types, &mechanism.visibility);
    let attributes: Vec<Attribute> = if mechanism.is_driven_by_choice() {
        let forwarded = mechanism.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        driver.attributes.iter().chain(forwarded).cloned().collect()
    } else {
        mechanism.attributes.clone()
    };
    let mut tokens = parameters(mechanism, name, &attributes, obstacles(&program.position, name), root);
    let inputs = ident(&types.inputs);
    let members: Vec<&Coordinate> = driver.inputs.iter().map(|&index| &mechanism.coordinates[index]).collect();
    let title = format!(
        " The independent coordinates v of [`{name}`] by name; also used for their rates `v'` and accelerations `v''`."
    );
    tokens.extend(by_name(mechanism, &inputs, &title, &members, &described, root));
    let fields = Fields::of(members.iter().map(|member| &member.name));
    let (names, count, mark) = (&fields.names, fields.count(), fields.mark());
    tokens.extend(conversions(&inputs, &fields, &quote!(#root::__rt::Column<T, #root::__rt::D<#count>>), root));
    for order in orders(mechanism) {
        let all = ident(order.type_of(types));
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<&#all<T>> for #inputs<T> {
                fn from(all: &#all<T>) -> Self {
                    Self { #(#names: all.#names,)* #mark }
                }
            }
        });
    }
    if let &[only] = &*driver.inputs {
        let field = field(&mechanism.coordinates[only].name);
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<T> for #inputs<T> {
                fn from(#field: T) -> Self {
                    Self { #field }
                }
            }
        });
    }
    if program.derived.is_none() && Guess::may_have_one_input(driver) {
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<T> for #inputs<T> {
                fn from(_: T) -> Self {
                    ::core::unreachable!()
                }
            }
        });
    }
    let members = program.derived.as_ref().map_or_else(
        || pose::guessed(mechanism, driver, root),
        |derived| pose::fields(mechanism, &derived.fields, root),
    );
    let title = comment(&format!(
        " A position of [`{name}`] with each angle as its direction (cos, sin), so that functions of it compute no sines."
    ));
    let (pose_name, derives) = (ident(&types.pose), derives_of_pose(mechanism, root));
    tokens.extend(quote! {
        #[doc = #title]
        #derives
        #visibility struct #pose_name<T = f64> { #members }
    });
    tokens.extend(motion::motions(mechanism, name, types, root));
    tokens.extend(branch(of, program, root));
    tokens
}

/// A doc comment that says which groups have no closed form, and where their positions come from.
fn obstacles(position: &Position, name: &TypeName) -> Option<TokenStream> {
    let (mut sentences, from_guess) = (position.obstacles(), format!("[`{name}::assemble_near`]"));
    sentences.extend(position.modes.iter().map(|Modes { unknowns, most, .. }| {
        let unknowns = unknowns.replace(", ", "`, `");
        format!("The group of `{unknowns}` has no closed form, but a list of its positions, at most {most}.")
    }));
    let from_inputs = match position.has_few_branches() {
        true => format!("[`{name}::branches`] and [`{name}::assemble`] find"),
        false => format!("[`{name}::assemble`] finds"),
    };
    let way = match position.is_listed() {
        true => format!("{from_inputs} them without a guess, {from_guess} follows one along a motion."),
        false => format!("{from_guess} finds its position from a guess."),
    };
    let text = comment(&format!("\n\n {} {way}", sentences.join(" ")));
    (!sentences.is_empty()).then(|| quote!(#[doc = #text]))
}
