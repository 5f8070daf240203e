//! The types of a mechanism: parameters, coordinates, inputs, unknowns, points, outputs, pose, motion.

use proc_macro2::{Delimiter, Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use syn::Attribute;

use super::methods::{AngleTurn, Branches};
use super::names::{comment, ident, string};
use super::pose::PosePlan;
use super::tokens::Tokens;
use super::{Types, expression};
use crate::derivation::Derivation;
use crate::graph::{Number, Texts};
use crate::model::{Coordinate, Driver, Mechanism, Name, Parameter};

/// A field name with the user's span, so that editors lead from one to the other.
pub(super) fn field(name: &Name) -> Ident {
    Ident::new(&name.field, proc_macro2::Span::call_site().located_at(name.span))
}

/// The user's doc comment, or else `text`.
pub(super) fn docs(attributes: &[Attribute], text: &str) -> TokenStream {
    let own: Vec<&Attribute> = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).collect();
    if own.is_empty() {
        let text = comment(&format!(" {text}"));
        quote!(#[doc = #text])
    } else {
        quote!(#(#own)*)
    }
}

/// A struct without fields still has its scalar: the member, and its value.
fn phantom(fields: &[Ident]) -> (Option<TokenStream>, Option<TokenStream>) {
    let empty = fields.is_empty();
    (
        empty.then(|| quote!(scalar: ::core::marker::PhantomData<T>)),
        empty.then(|| quote!(scalar: ::core::marker::PhantomData)),
    )
}

/// The name of that member, for the macros of the runtime.
fn mark(is_empty: bool) -> Option<Ident> {
    is_empty.then(|| ident("scalar"))
}

pub(super) fn derives() -> TokenStream {
    quote!(#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)])
}

/// The types that all drivers of a mechanism share.
pub(super) fn shared(mechanism: &Mechanism, derives: &TokenStream, private: &TokenStream) -> TokenStream {
    let visibility = &mechanism.visibility;
    let name = &mechanism.name;
    let mut tokens = TokenStream::new();
    if mechanism.is_driven_by_choice() {
        tokens.extend(parameters(mechanism, name, &mechanism.attributes, private));
        for driver in &mechanism.drivers {
            let other = &driver.name;
            let fields: Vec<Ident> = mechanism.parameters.iter().map(|parameter| field(&parameter.name)).collect();
            let (_, no_scalar) = phantom(&fields);
            for (from, to) in [(name, other), (other, name)] {
                tokens.extend(quote! {
                    impl<T> ::core::convert::From<#from<T>> for #to<T> {
                        fn from(parameters: #from<T>) -> Self {
                            let #from { #(#fields,)* .. } = parameters;
                            Self { #(#fields,)* #no_scalar }
                        }
                    }
                });
            }
        }
    }
    let coordinates = format_ident!("{name}Coordinates", span = proc_macro2::Span::call_site());
    let order = mechanism.drivers.first().map(|driver| mechanism.coordinate_order(driver)).unwrap_or_default();
    let members: Vec<&Coordinate> = order.iter().map(|&index| &mechanism.coordinates[index]).collect();
    let title = comment(&format!(" The coordinates q of [`{name}`] by name; their rates and accelerations as well."));
    tokens.extend(coordinate_struct(mechanism, &coordinates, &title, &members, derives));
    let (named_members, scalar) = (named(members.iter().map(|member| &member.name)), mark(members.is_empty()));
    tokens.extend(quote!(#private::__coordinates!(#coordinates #named_members #scalar);));
    for (suffix, what, names) in [
        ("Points", "points", mechanism.points.iter().map(|p| (&p.name, &p.attributes)).collect::<Vec<_>>()),
        ("Outputs", "outputs", mechanism.outputs.iter().map(|o| (&o.name, &o.attributes)).collect()),
    ] {
        if names.is_empty() {
            continue;
        }
        let ident = format_ident!("{name}{suffix}", span = proc_macro2::Span::call_site());
        let kind = &what[..what.len() - 1];
        let members = names.iter().map(|(name, attributes)| {
            let (docs, field) = (docs(attributes, &format!("The {kind} `{}`.", name.text)), field(name));
            quote!(#docs pub #field: Q)
        });
        let title = comment(&format!(" One quantity for each of the {what} of [`{name}`]."));
        let named = named(names.iter().map(|(name, _)| *name));
        tokens.extend(quote! {
            #[doc = #title]
            #derives
            #visibility struct #ident<Q> { #(#members),* }
            #private::__quantities!(#ident #named);
        });
    }
    tokens
}

/// The types of one driver, and its parameters.
pub(super) fn of_driver(
    mechanism: &Mechanism,
    driver: &Driver,
    types: &Types,
    plan: Option<&PosePlan>,
    derivation: Option<&Derivation>,
    private: &TokenStream,
) -> TokenStream {
    let Types { driver: name, inputs, unknowns, pose, coordinates, points, outputs, motion, derives, .. } = types;
    let visibility = &mechanism.visibility;
    let attributes: Vec<Attribute> = if mechanism.is_driven_by_choice() {
        let forwarded = mechanism.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        driver.attributes.iter().chain(forwarded).cloned().collect()
    } else {
        mechanism.attributes.clone()
    };
    let mut tokens = parameters(mechanism, name, &attributes, private);
    for (ident, what, indices) in
        [(inputs, "independent coordinates v", &driver.inputs), (unknowns, "dependent coordinates u", &driver.unknowns)]
    {
        let members: Vec<&Coordinate> = indices.iter().map(|&index| &mechanism.coordinates[index]).collect();
        let title = comment(&format!(" The {what} of [`{name}`] by name; their rates and accelerations as well."));
        tokens.extend(coordinate_struct(mechanism, ident, &title, &members, derives));
        let (named, scalar) = (named(members.iter().map(|member| &member.name)), mark(members.is_empty()));
        tokens.extend(quote!(#private::__part_of_coordinates!(#ident #named #coordinates #scalar);));
    }
    if let &[only] = driver.inputs.as_slice() {
        let field = field(&mechanism.coordinates[only].name);
        tokens.extend(quote! {
            impl<T: #private::Real> ::core::convert::From<T> for #inputs<T> {
                fn from(#field: T) -> Self {
                    Self { #field }
                }
            }
        });
    }
    let members = plan
        .map_or_else(|| quote!(scalar: ::core::marker::PhantomData<T>), |plan| pose_fields(plan, derivation, private));
    let title = comment(&format!(
        " A position of [`{name}`] ready for use: each angle as its direction (cos, sin), so that whatever follows needs no trigonometry."
    ));
    tokens.extend(quote! {
        #[doc = #title]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #pose<T = f64> { #members }
    });
    let (position_type, mut rest) = (quote!(#coordinates<T>), TokenStream::new());
    if !mechanism.points.is_empty() {
        rest.extend(quote!(/// Position, velocity and acceleration of the points.
 pub points: #points<#private::PointMotion<T>>,));
    }
    if !mechanism.outputs.is_empty() {
        rest.extend(quote!(/// Value, rate and acceleration of the outputs.
 pub outputs: #outputs<#private::OutputMotion<T>>,));
    }
    let title = comment(&format!(" A position of [`{name}`] with its velocity and acceleration."));
    tokens.extend(quote! {
        #[doc = #title]
        #derives
        #visibility struct #motion<T = f64> {
            /// The position q.

            pub position: #position_type,
            /// The velocity q'.

            pub velocity: #position_type,
            /// The acceleration q''.

            pub acceleration: #position_type,
            #rest
        }
    });
    tokens
}

fn pose_fields(plan: &PosePlan, derivation: Option<&Derivation>, private: &TokenStream) -> TokenStream {
    let Some(derivation) = derivation else { return TokenStream::new() };
    let mut members = TokenStream::new();
    let mut texts = Texts::default();
    for (angle, name) in &plan.directions {
        let ident = ident(name);
        let text = comment(&format!(" The direction of `{}`.", texts.of(&derivation.graph, *angle)));
        members.extend(quote!(#[doc = #text] pub #ident: #private::UnitComplex<T>,));
    }
    for (index, name, _) in &plan.values {
        let ident = ident(name);
        let text = comment(&format!(" `{}` itself.", derivation.coordinates[*index].name));
        members.extend(quote!(#[doc = #text] pub #ident: T,));
    }
    for (node, name, _) in &plan.externals {
        let ident = ident(name);
        let text = comment(&format!(" `{}`.", texts.of(&derivation.graph, *node)));
        members.extend(quote!(#[doc = #text] pub #ident: T,));
    }
    for (block, name, _) in &plan.determinants {
        let Some(determinant) = derivation.blocks[*block].determinant else { continue };
        let of = if derivation.blocks.len() == 1 {
            "det J".to_owned()
        } else {
            format!(
                "The determinant of the block of `{}`,",
                derivation.blocks[*block].names(derivation).replace(", ", "`, `")
            )
        };
        let text = comment(&format!(
            " {of} = `{}`, from the angles themselves.",
            texts.of(&derivation.graph, determinant.value)
        ));
        let ident = ident(name);
        members.extend(quote!(#[doc = #text] pub #ident: T,));
    }
    members
}

/// More arguments than this are told apart by nobody: there the literal with its names is better.
pub(super) const MOST_ARGUMENTS: usize = 7;

fn parameters(mechanism: &Mechanism, name: &Ident, attributes: &[Attribute], private: &TokenStream) -> TokenStream {
    let visibility = &mechanism.visibility;
    let fields: Vec<Ident> = mechanism.parameters.iter().map(|parameter| field(&parameter.name)).collect();
    let (scalar, no_scalar) = phantom(&fields);
    let number = fields.len();
    let members = mechanism.parameters.iter().zip(&fields).map(|(parameter, field)| {
        let docs = docs(&parameter.attributes, &format!("`{}`: {}.", parameter.name.text, parameter.kind));
        let other = parameter.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        quote!(#docs #(#other)* pub #field: T)
    });
    let own_docs = attributes.iter().any(|attribute| attribute.path().is_ident("doc"));
    let title = (!own_docs).then(|| {
        let text = comment(&format!(" The parameters of the mechanism `{name}`."));
        quote!(#[doc = #text])
    });
    let (named, mark) = (named(mechanism.parameters.iter().map(|parameter| &parameter.name)), mark(fields.is_empty()));
    let mut tokens = quote! {
        #title
        #(#attributes)*
        #visibility struct #name<T = f64> { #(#members,)* #scalar }
        #private::__parameters!(#name #named #mark);
    };
    if number <= MOST_ARGUMENTS {
        tokens.extend(quote! {
            impl<T: #private::Real> #name<T> {
                /// The mechanism with these parameters.

                #[must_use]
                pub const fn new(#(#fields: T),*) -> Self {
                    Self { #(#fields,)* #no_scalar }
                }
            }
        });
    }
    let defaults: Option<Vec<TokenStream>> =
        mechanism.parameters.iter().map(|parameter| default_of(mechanism, parameter)).collect();
    if let Some(defaults) = defaults {
        tokens.extend(quote! {
            // Of one scalar only, so that it need not be named.
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self { #(#fields: #defaults,)* #no_scalar }
                }
            }
        });
    }
    tokens
}

/// The default of a parameter as an `f64`.
pub(super) fn default_of(mechanism: &Mechanism, parameter: &Parameter) -> Option<TokenStream> {
    let node = parameter.default?;
    let graph = &mechanism.graph;
    let number = graph.as_number(node).or_else(|| graph.constant_value(node).map(Number::Float))?;
    Some(expression::plain(number))
}

fn coordinate_struct(
    mechanism: &Mechanism,
    name: &Ident,
    title: &Literal,
    coordinates: &[&Coordinate],
    derives: &TokenStream,
) -> TokenStream {
    let visibility = &mechanism.visibility;
    let members = coordinates.iter().map(|coordinate| {
        let docs = docs(&coordinate.attributes, &format!("`{}`: {}.", coordinate.name.text, coordinate.kind));
        let field = field(&coordinate.name);
        quote!(#docs pub #field: T)
    });
    let scalar = coordinates.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<T>));
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #name<T = f64> { #(#members,)* #scalar }
    }
}

/// The fields of a type with what they are called, and their number, for the macros of the runtime.
fn named<'a>(names: impl Iterator<Item = &'a Name>) -> TokenStream {
    let (mut members, mut count) = (Tokens::default(), 0);
    for name in names {
        members.ident(&field(name));
        members.append(string(&name.text));
        count += 1;
    }
    let mut all = Tokens::default();
    all.group(Delimiter::Bracket, members);
    all.append(Literal::usize_unsuffixed(count));
    all.into()
}

/// Of more groups than this nobody tries all branches.
pub(super) const MOST_BRANCHING: usize = 16;

/// The side of each group that has two solutions and, where the position has a closed form, the turn of each angle
/// whose number matters.
pub(super) fn branch(
    mechanism: &Mechanism,
    types: &Types,
    Branches { sides, turns }: &Branches,
    is_assembled: bool,
    private: &TokenStream,
) -> TokenStream {
    let visibility = &mechanism.visibility;
    let Types { driver, branch, derives, .. } = types;
    let turns: &[AngleTurn] = if is_assembled { turns } else { &[] };
    let title = comment(&format!(" Which solution is meant of each group of [`{driver}`] that has two."));
    let members = sides.iter().map(|(side, choice)| {
        let [first, second] = choice.words().map(str::to_lowercase);
        let docs = comment(&format!(" Of the group of `{side}`: {first} or {second}."));
        let choice = ident(choice.name());
        quote!(#[doc = #docs] pub #side: #private::#choice)
    });
    let turn_members = turns.iter().map(|AngleTurn { field, coordinate, .. }| {
        let docs = comment(&format!(
            " The turn of `{coordinate}`: 0 for its principal value, between -pi and pi; n adds 2 pi n."
        ));
        quote!(#[doc = #docs] pub #field: i32)
    });
    let zeros: Vec<TokenStream> = turns.iter().map(|AngleTurn { field, .. }| quote!(#field: 0)).collect();
    let new = (sides.len() <= MOST_ARGUMENTS).then(|| {
        let arguments = sides.iter().map(|(side, choice)| {
            let choice = ident(choice.name());
            quote!(#side: #private::#choice)
        });
        let names = sides.iter().map(|(side, _)| side);
        let text = comment(match turns {
            [] => " The branch with these solutions.",
            _ if sides.is_empty() => " The branch with every angle at its principal value.",
            _ => " The branch with these solutions, and every angle at its principal value.",
        });
        quote! {
            #[doc = #text]
            #[must_use]
            pub const fn new(#(#arguments),*) -> Self {
                Self { #(#names,)* #(#zeros),* }
            }
        }
    });
    let bits = (0..sides.len()).map(|place| match place {
        0 => quote!(bits & 1),
        place => {
            let place = Literal::usize_unsuffixed(place);
            quote!((bits >> #place) & 1)
        }
    });
    let each = sides.iter().zip(bits).map(|((side, choice), bit)| {
        let ([first, second], choice) = (choice.words().map(ident), ident(choice.name()));
        quote!(#side: if #bit == 0 { #private::#choice::#first } else { #private::#choice::#second })
    });
    let every = match sides.len() {
        0 => quote!(::core::iter::once(Self { #(#zeros),* })),
        many => {
            let count = Literal::u32_unsuffixed(1 << many.min(MOST_BRANCHING));
            quote! {
                ::core::iter::Iterator::map(0..#count, |bits: u32| Self {
                    #(#each,)* #(#zeros),*
                })
            }
        }
    };
    let all = (sides.len() <= MOST_BRANCHING).then(|| {
        let text = if turns.is_empty() {
            " Every branch there could be; at a given input some may not exist."
        } else {
            " Every branch there could be, with angles at their principal values; at a given input some may not exist."
        };
        let text = comment(text);
        quote! {
            #[doc = #text]
            pub fn all() -> impl ::core::iter::Iterator<Item = Self> {
                #every
            }
        }
    });
    let functions = (new.is_some() || all.is_some()).then(|| quote!(impl #branch { #new #all }));
    let default = sides.is_empty().then(|| quote!(#[derive(::core::default::Default)]));
    quote! {
        #[doc = #title]
        #derives
        #default
        #visibility struct #branch { #(#members,)* #(#turn_members),* }
        #functions
    }
}
