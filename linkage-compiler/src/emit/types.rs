//! The types of a mechanism: parameters, coordinates and their derivatives, inputs, points, outputs, pose, motion,
//! branch.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};
use syn::Attribute;

use super::expression::{self, literal};
use super::motion;
use super::names::{comment, ident};
use super::pose;
use crate::derivation::Derivation;
use crate::graph::Number;
use crate::lower::Code;
use crate::model::{Coordinate, Kind, Mechanism, Name, Parameter, Request};
use crate::program::{Order, Position, Program, Side, TypeNames};

/// `new` is emitted only up to this number of parameters; longer argument lists are hard to read at the call.
pub(super) const MOST_ARGUMENTS: usize = 7;

/// A field name with the user's span, so that editors link the field to its declaration.
pub(super) fn field(name: &Name) -> Ident {
    Ident::new(&name.field, proc_macro2::Span::call_site().located_at(name.span))
}

/// The user's doc comment, or `text` if there is none.
pub(super) fn docs(attributes: &[Attribute], text: &str) -> TokenStream {
    let own: Vec<&Attribute> = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).collect();
    if own.is_empty() {
        let text = comment(&format!(" {text}"));
        quote!(#[doc = #text])
    } else {
        quote!(#(#own)*)
    }
}

/// The user's doc comment of a parameter, or its name and kind; then its default.
pub(super) fn docs_of_parameter(mechanism: &Mechanism, parameter: &Parameter) -> TokenStream {
    let docs = docs(&parameter.attributes, &format!("`{}`: {}.", parameter.name.text, parameter.kind));
    let default = parameter.default.map(|default| {
        let text = comment(&format!(" Default: {}.", mechanism.graph.text(default)));
        quote!(#[doc = ""] #[doc = #text])
    });
    quote!(#docs #default)
}

/// `#[derive(..)]` for types of plain data.
pub(super) fn derives(mechanism: &Mechanism, root: &TokenStream) -> TokenStream {
    let serde = serde(mechanism, root);
    quote! {
        #[derive(
            ::core::clone::Clone,
            ::core::marker::Copy,
            ::core::fmt::Debug,
            ::core::cmp::PartialEq,
            ::core::cmp::Eq,
        )]
        #serde
    }
}

/// `Serialize` and `Deserialize` on request.
fn serde(mechanism: &Mechanism, root: &TokenStream) -> Option<TokenStream> {
    let path = serde_alias(mechanism).to_string();
    mechanism.requests.contains(&Request::Serde).then(|| {
        quote! {
            #[derive(#root::__rt::serde::Serialize, #root::__rt::serde::Deserialize)]
            #[serde(crate = #path)]
        }
    })
}

/// `Serialize` and `Deserialize` of parameters on request, unless the user derives them.
pub(super) fn serde_of_parameters(
    mechanism: &Mechanism,
    attributes: &[&Attribute],
    root: &TokenStream,
) -> Option<TokenStream> {
    let is_own = attributes.iter().any(|attribute| attribute.meta.to_token_stream().to_string().contains("Serialize"));
    serde(mechanism, root).filter(|_| !is_own)
}

/// The name of the crate `serde` next to the types: its derives take a path as text, which `$crate` cannot be.
fn serde_alias(mechanism: &Mechanism) -> Ident {
    ident(&format!("__{}_serde", mechanism.name))
}

/// The fields of a struct, all of type `T`; a struct without fields has a `PhantomData<T>`.
struct Fields<'a> {
    names: Vec<Ident>,
    texts: Vec<&'a str>,
}

impl<'a> Fields<'a> {
    fn of(names: impl Iterator<Item = &'a Name>) -> Self {
        let (names, texts) = names.map(|name| (field(name), name.text.as_str())).unzip();
        Self { names, texts }
    }

    /// The name of an argument, with an underscore if there are no fields to use it.
    fn argument(&self, name: &str) -> Ident {
        expression::argument(name, !self.names.is_empty())
    }

    fn count(&self) -> Literal {
        literal(self.names.len())
    }

    /// The declaration of the `PhantomData` field.
    fn phantom(&self) -> Option<TokenStream> {
        self.names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<T>))
    }

    /// The value of the `PhantomData` field.
    fn mark(&self) -> Option<TokenStream> {
        self.names.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData))
    }
}

/// The name of a second scalar type parameter; it differs from all types of the user.
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
    let names = mechanism.drivers.first().map(|driver| TypeNames::new(mechanism, driver));
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

/// The orders of derivatives with respect to time for which types of coordinates are emitted.
fn orders(mechanism: &Mechanism) -> impl Iterator<Item = Order> {
    let has_jerks = mechanism.requests.contains(&Request::Jerk);
    Order::ALL.into_iter().filter(move |&order| order != Order::Jerk || has_jerks)
}

/// The struct of all coordinates by name, or of their derivatives with respect to time.
fn coordinates(
    mechanism: &Mechanism,
    names: &TypeNames,
    order: Order,
    members: &[&Coordinate],
    root: &TokenStream,
) -> TokenStream {
    let [what, of_one] = match order {
        Order::Value => ["coordinates q", ""],
        Order::Rate => ["rates q' of the coordinates", "rate"],
        Order::Acceleration => ["accelerations q'' of the coordinates", "acceleration"],
        Order::Jerk => ["jerks q''' of the coordinates", "jerk"],
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
    by_name(mechanism, &ident(names.of(order)), &title, members, &docs, root)
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
fn described(coordinate: &Coordinate) -> TokenStream {
    docs(&coordinate.attributes, &format!("`{}`: {}.", coordinate.name.text, coordinate.kind))
}

/// A struct with a number for each of some coordinates, and its conversions from and to vectors.
fn by_name(
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
fn conversions(name: &Ident, fields: &Fields, vector: &TokenStream, root: &TokenStream) -> TokenStream {
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

/// The types of one driver: parameters, inputs, pose, motion, branch.
pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>, root: &TokenStream) -> TokenStream {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
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
        " The independent coordinates v of [`{name}`] by name; also used for their rates v' and accelerations v''."
    );
    tokens.extend(by_name(mechanism, &inputs, &title, &members, &described, root));
    let fields = Fields::of(members.iter().map(|member| &member.name));
    let (names, count, mark) = (&fields.names, fields.count(), fields.mark());
    tokens.extend(conversions(&inputs, &fields, &quote!(#root::__rt::Column<T, #root::__rt::D<#count>>), root));
    for order in orders(mechanism) {
        let all = ident(types.of(order));
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
    let derived = program.derived.as_ref().zip(derivation);
    if derived.is_none() && driver.inputs.len() != 1 {
        // The number of inputs is not known: accept a number as well.
        tokens.extend(quote! {
            impl<T: #root::__rt::Real> ::core::convert::From<T> for #inputs<T> {
                fn from(_: T) -> Self {
                    ::core::unreachable!()
                }
            }
        });
    }
    let members = derived.map_or_else(
        || pose::guessed(mechanism, driver, root),
        |(derived, derivation)| pose::fields(derived, derivation, root),
    );
    let title = comment(&format!(
        " A position of [`{name}`] with each angle as its direction (cos, sin), so that functions of it compute no sines."
    ));
    let pose_name = ident(&types.pose);
    tokens.extend(quote! {
        #[doc = #title]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #pose_name<T = f64> { #members }
    });
    tokens.extend(motion::kinematics(mechanism, name, types, root));
    tokens.extend(motion::motion(mechanism, name, types, root));
    tokens.extend(branch(program, root));
    tokens
}

/// A doc comment that says which groups have no closed form.
fn obstacles(position: &Position, name: &Ident) -> Option<TokenStream> {
    let obstacles = position.obstacles();
    let text = format!("\n\n {} [`{name}::assemble_near`] finds its position from a guess.", obstacles.join(" "));
    let text = comment(&text);
    (!obstacles.is_empty()).then(|| quote!(#[doc = #text]))
}

fn parameters(
    mechanism: &Mechanism,
    name: &Ident,
    attributes: &[Attribute],
    note: Option<TokenStream>,
    root: &TokenStream,
) -> TokenStream {
    let visibility = &mechanism.visibility;
    let fields = Fields::of(mechanism.parameters.iter().map(|parameter| &parameter.name));
    let (names, texts, count) = (&fields.names, &fields.texts, fields.count());
    let (phantom, mark, other) = (fields.phantom(), fields.mark(), other_scalar(mechanism));
    let [all, scalar] = ["parameters", "scalar"].map(|name| fields.argument(name));
    let members = mechanism.parameters.iter().zip(names).map(|(parameter, field)| {
        let docs = docs_of_parameter(mechanism, parameter);
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
            #[doc = " A mechanism with these parameters."]
            #[must_use]
            pub const fn new(#(#names: T),*) -> Self {
                Self { #(#names,)* #mark }
            }
        }
    });
    let defaults = mechanism.parameters.iter().map(|parameter| default_of(mechanism, parameter));
    let default = defaults.collect::<Option<Vec<_>>>().map(|defaults| {
        quote! {
            // For `f64` only, so that type inference needs no annotation.
            impl ::core::default::Default for #name {
                fn default() -> Self {
                    Self { #(#names: #defaults,)* #mark }
                }
            }
        }
    });
    let serde = serde_of_parameters(mechanism, &attributes.iter().collect::<Vec<_>>(), root);
    quote! {
        #title
        #(#attributes)*
        #note
        #serde
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
            #[doc = " The declared names of the parameters, in order."]
            pub const PARAMETERS: [&'static str; #count] = [#(#texts),*];
            #new
            #[doc = " This mechanism with another scalar type: applies a function to each parameter."]
            #[must_use]
            pub fn map<#other>(self, #scalar: impl ::core::ops::Fn(T) -> #other) -> #name<#other> {
                #name { #(#names: #scalar(self.#names),)* #mark }
            }
        }
        #default
    }
}

/// The default value of a parameter as an `f64`.
pub(super) fn default_of(mechanism: &Mechanism, parameter: &Parameter) -> Option<TokenStream> {
    let node = parameter.default?;
    let graph = &mechanism.graph;
    let number = graph.as_number(node).or_else(|| graph.constant_value(node).map(Number::Float))?;
    Some(expression::plain(number))
}

/// The branch type: a field for each group with two solutions and, if the position has a closed form, one for the turn
/// of each angle that the pose stores as a number.
fn branch(program: &Program<Code>, root: &TokenStream) -> TokenStream {
    let visibility = &program.signatures.mechanism.visibility;
    let (driver, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let Position { sides, turns, is_closed, .. } = &program.position;
    let turns = if *is_closed { turns.as_slice() } else { &[] };
    let derives = derives(program.signatures.mechanism, root);
    let title = comment(&match program.signatures.is_open() {
        true => format!(" The branch of [`{driver}`]: an open chain has a single one."),
        false => format!(" The assembly mode of [`{driver}`]: one of the two solutions of each group that has two."),
    });
    let example = (1..=MOST_ARGUMENTS).contains(&sides.len()).then(|| {
        let sides: Vec<String> =
            sides.iter().map(|Side { choice, .. }| format!("{}::{}", choice.name(), choice.variants()[0])).collect();
        let text = comment(&format!(" For instance `{branch}::new({})`.", sides.join(", ")));
        quote!(#[doc = ""] #[doc = #text])
    });
    let choices: Vec<(Ident, TokenStream)> = sides
        .iter()
        .map(|side| {
            let choice = ident(side.choice.name());
            (ident(&side.field), quote!(#root::__rt::#choice))
        })
        .collect();
    let names: Vec<&Ident> = choices.iter().map(|(side, _)| side).collect();
    let members = sides.iter().zip(&choices).map(|(Side { meaning, .. }, (side, of))| {
        let docs = comment(&format!(" {meaning}"));
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
            _ if sides.is_empty() => " The branch with all turns 0.",
            _ => " The branch with these solutions and all turns 0.",
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
    let each = sides.iter().zip(&choices).zip(bits).map(|((Side { choice, .. }, (side, of)), bit)| {
        let [first, second] = choice.variants().map(ident);
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
            " All branches; some may not exist at a given input."
        } else {
            " All branches with turns 0; some may not exist at a given input."
        };
        let text = comment(text);
        quote! {
            #[doc = #text]
            pub fn all() -> impl ::core::iter::Iterator<Item = Self> + ::core::clone::Clone {
                #every
            }
        }
    });
    let functions = (new.is_some() || all.is_some()).then(|| quote!(impl #branch { #new #all }));
    let default = sides.is_empty().then(|| quote!(, ::core::default::Default));
    quote! {
        #[doc = #title]
        #example
        #derives
        #[derive(::core::hash::Hash #default)]
        #visibility struct #branch { #(#members,)* #(#turn_members),* }
        #functions
    }
}
