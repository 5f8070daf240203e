//! The types of a mechanism: parameters, coordinates, inputs, unknowns, points, outputs, pose, motion, branch.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::Attribute;

use super::expression::{self, literal};
use super::names::{comment, ident};
use crate::derivation::Derivation;
use crate::graph::{Number, Texts};
use crate::lower::Code;
use crate::model::{Coordinate, Mechanism, Name, Parameter};
use crate::program::{Derived, Position, Program, TypeNames};

/// More arguments than this are told apart by nobody: there the literal with its names is better.
pub(super) const MOST_ARGUMENTS: usize = 7;

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

/// The traits of plain data.
fn derives() -> TokenStream {
    quote!(#[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::cmp::PartialEq)])
}

/// A struct of fields that each hold the scalar; without fields it still has its scalar.
struct Fields<'a> {
    names: Vec<Ident>,
    texts: Vec<&'a str>,
}

impl<'a> Fields<'a> {
    fn of(names: impl Iterator<Item = &'a Name>) -> Self {
        let (names, texts) = names.map(|name| (field(name), name.text.as_str())).unzip();
        Self { names, texts }
    }

    /// The name of an argument that only the fields use.
    fn argument(&self, name: &str) -> Ident {
        expression::argument(name, !self.names.is_empty())
    }

    fn count(&self) -> Literal {
        literal(self.names.len())
    }

    /// The member that only holds the scalar.
    fn phantom(&self) -> Option<TokenStream> {
        self.names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<T>))
    }

    /// The value of that member.
    fn mark(&self) -> Option<TokenStream> {
        self.names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData))
    }
}

/// The name of a second scalar, which no type of the user's has.
pub(super) fn other_scalar(mechanism: &Mechanism) -> Ident {
    let scenes = mechanism.scenes.iter().map(|scene| &scene.name);
    let types: Vec<&Ident> = mechanism.drivers.iter().map(|driver| &driver.name).chain(scenes).collect();
    let mut name = "S".to_owned();
    while types.iter().any(|taken| **taken == name) || mechanism.name == name {
        name.push('S');
    }
    ident(&name)
}

/// The types that all drivers of a mechanism share.
pub(super) fn shared(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let (visibility, name, derives) = (&mechanism.visibility, &mechanism.name, derives());
    let mut tokens = TokenStream::new();
    if mechanism.is_driven_by_choice() {
        tokens.extend(parameters(mechanism, name, &mechanism.attributes, root));
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
    let names = mechanism.drivers.first().map(|driver| TypeNames::new(mechanism, driver));
    let Some(names) = names else { return tokens };
    let order = mechanism.drivers.first().map(|driver| mechanism.coordinate_order(driver)).unwrap_or_default();
    let members: Vec<&Coordinate> = order.iter().map(|&index| &mechanism.coordinates[index]).collect();
    let title = format!(" The coordinates q of [`{name}`] by name; their rates and accelerations as well.");
    tokens.extend(coordinates(mechanism, &ident(&names.coordinates), &title, &members, root));
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
        let title = comment(&format!(" One quantity for each of the {what} of [`{name}`]."));
        tokens.extend(quote! {
            #[doc = #title]
            #derives
            #visibility struct #group<Q> { #(#declared),* }
            impl<Q> #group<Q> {
                #[doc = " The names as they were declared, in order."]
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

/// A struct of coordinates with its conversions from and to vectors.
fn coordinates(
    mechanism: &Mechanism,
    name: &Ident,
    title: &str,
    members: &[&Coordinate],
    root: &TokenStream,
) -> TokenStream {
    let (visibility, derives, title) = (&mechanism.visibility, derives(), comment(title));
    let fields = Fields::of(members.iter().map(|member| &member.name));
    let (names, texts, count) = (&fields.names, &fields.texts, fields.count());
    let (phantom, mark) = (fields.phantom(), fields.mark());
    let declared = members.iter().zip(names).map(|(coordinate, field)| {
        let docs = docs(&coordinate.attributes, &format!("`{}`: {}.", coordinate.name.text, coordinate.kind));
        quote!(#docs pub #field: T)
    });
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #name<T = f64> { #(#declared,)* #phantom }
        impl<T> #name<T> {
            #[doc = " The coordinates as they were declared, in order."]
            pub const NAMES: [&'static str; #count] = [#(#texts),*];
        }
        impl<T: #root::__rt::Real> ::core::convert::From<#root::__rt::SVector<T, #count>> for #name<T> {
            fn from(vector: #root::__rt::SVector<T, #count>) -> Self {
                let [[#(#names),*]] = vector.data.0;
                Self { #(#names,)* #mark }
            }
        }
        impl<T: #root::__rt::Real> ::core::convert::From<#name<T>> for #root::__rt::SVector<T, #count> {
            fn from(coordinates: #name<T>) -> Self {
                <Self as ::core::convert::From<[T; #count]>>::from([#(coordinates.#names),*])
            }
        }
    }
}

/// The types of one driver, and its parameters.
pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>, root: &TokenStream) -> TokenStream {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
    let (name, types, visibility) = (&driver.name, &program.signatures.types, &mechanism.visibility);
    let attributes: Vec<Attribute> = if mechanism.is_driven_by_choice() {
        let forwarded = mechanism.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        driver.attributes.iter().chain(forwarded).cloned().collect()
    } else {
        mechanism.attributes.clone()
    };
    let mut tokens = parameters(mechanism, name, &attributes, root);
    let all = ident(&types.coordinates);
    let (inputs, unknowns) = (ident(&types.inputs), ident(&types.unknowns));
    for (part, what, indices) in [
        (&inputs, "independent coordinates v", &*driver.inputs),
        (&unknowns, "dependent coordinates u", &*driver.unknowns),
    ] {
        let members: Vec<&Coordinate> = indices.iter().map(|&index| &mechanism.coordinates[index]).collect();
        let title = format!(" The {what} of [`{name}`] by name; their rates and accelerations as well.");
        tokens.extend(coordinates(mechanism, part, &title, &members, root));
        let fields = Fields::of(members.iter().map(|member| &member.name));
        let (names, mark) = (&fields.names, fields.mark());
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<&#all<T>> for #part<T> {
                fn from(q: &#all<T>) -> Self {
                    Self { #(#names: q.#names,)* #mark }
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
    let derived = program.derived.as_ref().zip(derivation);
    if derived.is_none() && driver.inputs.len() != 1 {
        // How many inputs were meant is not known.
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<T> for #inputs<T> {
                fn from(_: T) -> Self {
                    ::core::unreachable!()
                }
            }
        });
    }
    let members = derived.map_or_else(
        || quote!(scalar: ::core::marker::PhantomData<T>),
        |(derived, derivation)| pose_fields(derived, derivation, root),
    );
    let title = comment(&format!(
        " A position of [`{name}`] ready for use: each angle as its direction (cos, sin), so that whatever follows needs no trigonometry."
    ));
    let pose = ident(&types.pose);
    tokens.extend(quote! {
        #[doc = #title]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #pose<T = f64> { #members }
    });
    tokens.extend(motion(mechanism, name, types, root));
    tokens.extend(branch(program, root));
    tokens
}

fn motion(mechanism: &Mechanism, name: &Ident, types: &TypeNames, root: &TokenStream) -> TokenStream {
    let (visibility, derives) = (&mechanism.visibility, derives());
    let (motion, coordinates) = (ident(&types.motion), ident(&types.coordinates));
    let points = (!mechanism.points.is_empty()).then(|| {
        let points = ident(&types.points);
        quote! {
            #[doc = " Position, velocity and acceleration of the points."]
            pub points: #points<#root::__rt::PointMotion<T>>,
        }
    });
    let outputs = (!mechanism.outputs.is_empty()).then(|| {
        let outputs = ident(&types.outputs);
        quote! {
            #[doc = " Value, rate and acceleration of the outputs."]
            pub outputs: #outputs<#root::__rt::OutputMotion<T>>,
        }
    });
    let title = comment(&format!(" A position of [`{name}`] with its velocity and acceleration."));
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #motion<T = f64> {
            #[doc = " The position q."]
            pub position: #coordinates<T>,
            #[doc = " The velocity q'."]
            pub velocity: #coordinates<T>,
            #[doc = " The acceleration q''."]
            pub acceleration: #coordinates<T>,
            #points
            #outputs
        }
    }
}

fn pose_fields(derived: &Derived, derivation: &Derivation, root: &TokenStream) -> TokenStream {
    let plan = &derived.pose;
    let mut texts = Texts::default();
    let mut members = TokenStream::new();
    let mut member = |name: &str, text: String, of: TokenStream| {
        let (name, text) = (ident(name), comment(&text));
        members.extend(quote!(#[doc = #text] pub #name: #of,));
    };
    for (angle, name) in &plan.directions {
        let text = format!(" The direction of `{}`.", texts.of(&derivation.graph, *angle));
        member(name, text, quote!(#root::__rt::UnitComplex<T>));
    }
    for (index, name, _) in &plan.values {
        member(name, format!(" `{}` itself.", derivation.coordinates[*index].name), quote!(T));
    }
    for (node, name, _) in &plan.externals {
        member(name, format!(" `{}`.", texts.of(&derivation.graph, *node)), quote!(T));
    }
    for (block, name, _) in &plan.determinants {
        let block = &derivation.blocks[*block];
        let Some(determinant) = block.determinant else { continue };
        let of = match derivation.blocks.len() {
            1 => "det J".to_owned(),
            _ => format!("The determinant of the block of `{}`,", block.names(derivation).replace(", ", "`, `")),
        };
        let formula = texts.of(&derivation.graph, determinant.value);
        member(name, format!(" {of} = `{formula}`, from the angles themselves."), quote!(T));
    }
    members
}

fn parameters(mechanism: &Mechanism, name: &Ident, attributes: &[Attribute], root: &TokenStream) -> TokenStream {
    let visibility = &mechanism.visibility;
    let fields = Fields::of(mechanism.parameters.iter().map(|parameter| &parameter.name));
    let (names, texts, count) = (&fields.names, &fields.texts, fields.count());
    let (phantom, mark, other) = (fields.phantom(), fields.mark(), other_scalar(mechanism));
    let [all, scalar] = ["parameters", "scalar"].map(|name| fields.argument(name));
    let members = mechanism.parameters.iter().zip(names).map(|(parameter, field)| {
        let docs = docs(&parameter.attributes, &format!("`{}`: {}.", parameter.name.text, parameter.kind));
        let other = parameter.attributes.iter().filter(|attribute| !attribute.path().is_ident("doc"));
        quote!(#docs #(#other)* pub #field: T)
    });
    let own_docs = attributes.iter().any(|attribute| attribute.path().is_ident("doc"));
    let title = (!own_docs).then(|| {
        let text = comment(&format!(" The parameters of the mechanism `{name}`."));
        quote!(#[doc = #text])
    });
    let new = (names.len() <= MOST_ARGUMENTS).then(|| {
        quote! {
            #[doc = " The mechanism with these parameters."]
            #[must_use]
            pub const fn new(#(#names: T),*) -> Self {
                Self { #(#names,)* #mark }
            }
        }
    });
    let defaults = mechanism.parameters.iter().map(|parameter| default_of(mechanism, parameter));
    let default = defaults.collect::<Option<Vec<_>>>().map(|defaults| {
        quote! {
            // Of one scalar only, so that it need not be named.
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self { #(#names: #defaults,)* #mark }
                }
            }
        }
    });
    quote! {
        #title
        #(#attributes)*
        #visibility struct #name<T = f64> { #(#members,)* #phantom }
        impl<T> ::core::convert::From<[T; #count]> for #name<T> {
            fn from([#(#names),*]: [T; #count]) -> Self {
                Self { #(#names,)* #mark }
            }
        }
        impl<T> ::core::convert::From<#name<T>> for [T; #count] {
            fn from(#all: #name<T>) -> Self {
                [#(#all.#names),*]
            }
        }
        impl<T: #root::__rt::Real> #name<T> {
            #[doc = " The parameters as they were declared, in order."]
            pub const PARAMETERS: [&'static str; #count] = [#(#texts),*];
            #new
            #[doc = " The same mechanism with another scalar."]
            #[must_use]
            pub fn map<#other>(self, #scalar: impl ::core::ops::Fn(T) -> #other) -> #name<#other> {
                #name { #(#names: #scalar(self.#names),)* #mark }
            }
        }
        #default
    }
}

/// The default of a parameter as an `f64`.
pub(super) fn default_of(mechanism: &Mechanism, parameter: &Parameter) -> Option<TokenStream> {
    let node = parameter.default?;
    let graph = &mechanism.graph;
    let number = graph.as_number(node).or_else(|| graph.constant_value(node).map(Number::Float))?;
    Some(expression::plain(number))
}

/// The side of each group that has two solutions and, where the position has a closed form, the turn of each angle
/// whose number matters.
fn branch(program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let visibility = &program.signatures.mechanism.visibility;
    let (driver, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let Position { sides, turns, is_closed, .. } = &program.position;
    let turns = if *is_closed { turns.as_slice() } else { &[] };
    let derives = derives();
    let title = comment(&format!(" Which solution is meant of each group of [`{driver}`] that has two."));
    let choices: Vec<(Ident, TokenStream)> = sides
        .iter()
        .map(|(side, choice)| {
            let choice = ident(choice.name());
            (ident(side), quote!(#root::__rt::#choice))
        })
        .collect();
    let names: Vec<&Ident> = choices.iter().map(|(side, _)| side).collect();
    let members = sides.iter().zip(&choices).map(|((text, choice), (side, of))| {
        let [first, second] = choice.words().map(str::to_lowercase);
        let docs = comment(&format!(" Of the group of `{text}`: {first} or {second}."));
        quote!(#[doc = #docs] pub #side: #of)
    });
    let turn_members = turns.iter().map(|turn| {
        let docs = comment(&format!(
            " The turn of `{}`: 0 for its principal value, between -pi and pi; n adds 2 pi n.",
            turn.coordinate
        ));
        let field = ident(&turn.field);
        quote!(#[doc = #docs] pub #field: i32)
    });
    let zeros: Vec<TokenStream> = turns
        .iter()
        .map(|turn| {
            let field = ident(&turn.field);
            quote!(#field: 0)
        })
        .collect();
    let new = (sides.len() <= MOST_ARGUMENTS).then(|| {
        let arguments = choices.iter().map(|(side, of)| quote!(#side: #of));
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
            let place = literal(place);
            quote!((bits >> #place) & 1)
        }
    });
    let each = sides.iter().zip(&choices).zip(bits).map(|(((_, choice), (side, of)), bit)| {
        let [first, second] = choice.words().map(ident);
        quote!(#side: if #bit == 0 { #of::#first } else { #of::#second })
    });
    let every = match sides.len() {
        0 => quote!(::core::iter::once(Self { #(#zeros),* })),
        many => {
            let count = Literal::u32_unsuffixed(1 << many.min(31));
            quote! {
                ::core::iter::Iterator::map(0..#count, |bits: u32| Self {
                    #(#each,)* #(#zeros),*
                })
            }
        }
    };
    let all = program.position.has_few_branches().then(|| {
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
