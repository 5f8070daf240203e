//! Lowered code and types as Rust.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};

use super::names::{ident, string};
use super::numbers::{constant, exact, is_long, literal, turn};
use super::printer::{Binding, Member, On, Style};
use crate::graph::{Function, Number};
use crate::program::{Constant, Intrinsic, Type};

/// The style of emitted code.
pub(super) struct Rust;

impl Style for Rust {
    type Text = TokenStream;

    fn brackets(&self, inside: TokenStream) -> TokenStream {
        quote!((#inside))
    }

    fn name(&self, name: &str) -> TokenStream {
        ident(name).into_token_stream()
    }

    fn number(&self, number: Number) -> TokenStream {
        constant(number)
    }

    fn turn(&self, _number: Number, count: i32, parts: u32) -> TokenStream {
        turn(count, parts)
    }

    fn turn_binding(&self) -> Binding {
        Binding::Product
    }

    fn exact(&self, number: Number) -> TokenStream {
        exact(number)
    }

    fn exact_binding(&self, number: Number) -> Binding {
        if is_long(number) { Binding::Product } else { Binding::Atom }
    }

    fn sum(&self, terms: Vec<(bool, TokenStream)>) -> TokenStream {
        let terms = terms.into_iter().enumerate().map(|(index, (is_negative, term))| match (index, is_negative) {
            (0, false) => term,
            (_, true) => quote!(- #term),
            (_, false) => quote!(+ #term),
        });
        terms.collect()
    }

    fn product(&self, factors: Vec<TokenStream>) -> TokenStream {
        let mut factors = factors.into_iter();
        let first = factors.next();
        quote!(#first #(* #factors)*)
    }

    fn quotient(&self, above: TokenStream, below: TokenStream) -> TokenStream {
        quote!(#above / #below)
    }

    fn square(&self, first: TokenStream, later: TokenStream) -> TokenStream {
        quote!(#first * #later)
    }

    fn square_binding(&self) -> Binding {
        Binding::Product
    }

    fn negative(&self, inside: TokenStream) -> TokenStream {
        quote!(-#inside)
    }

    fn argument(&self, binding: Binding, first: TokenStream) -> TokenStream {
        if binding < Binding::Atom { self.brackets(first) } else { first }
    }

    fn elementary(&self, function: Function, first: Option<TokenStream>, others: Vec<TokenStream>) -> TokenStream {
        let name = ident(function.method());
        quote!(#first.#name(#(#others),*))
    }

    fn all(&self, conditions: Vec<TokenStream>) -> TokenStream {
        if conditions.is_empty() { quote!(true) } else { quote!(#(#conditions)&*) }
    }

    fn text(&self, text: &str) -> TokenStream {
        string(text).into_token_stream()
    }

    fn count(&self, count: usize) -> TokenStream {
        literal(count).into_token_stream()
    }

    fn constant(&self, constant: Constant) -> TokenStream {
        if constant.is_of_runtime() { runtime(constant.path()) } else { parsed(constant.path()) }
    }

    fn field(&self, of: TokenStream, name: &str) -> TokenStream {
        let name = member(name);
        quote!(#of.#name)
    }

    fn index(&self, of: TokenStream, index: usize) -> TokenStream {
        let index = literal(index);
        quote!(#of[#index])
    }

    fn entry(&self, of: TokenStream, index: TokenStream) -> TokenStream {
        quote!(#of[#index])
    }

    fn list(&self, values: Vec<TokenStream>) -> TokenStream {
        quote!([#(#values),*])
    }

    fn repeated(&self, value: TokenStream, count: usize) -> TokenStream {
        let count = literal(count);
        quote!([#value; #count])
    }

    fn tuple(&self, values: Vec<TokenStream>) -> TokenStream {
        match values.as_slice() {
            [only] => quote!((#only,)),
            _ => quote!((#(#values),*)),
        }
    }

    fn structure(&self, of: &Type, members: Vec<Member<TokenStream>>, rest: Option<TokenStream>) -> TokenStream {
        let of = path(of);
        let members = members.into_iter().map(|(name, value)| {
            let name = member(&name);
            value.map_or_else(|| name.clone(), |value| quote!(#name: #value))
        });
        let members = members.chain(rest.map(|rest| quote!(..#rest)));
        quote!(#of { #(#members),* })
    }

    fn call(&self, on: On<TokenStream>, name: &str, arguments: Vec<TokenStream>) -> TokenStream {
        match on {
            On::Value(of) => {
                let name = ident(name);
                quote!(#of.#name(#(#arguments),*))
            }
            On::Type(of) => {
                let (of, name) = (path(&of), ident(name));
                quote!(#of::#name(#(#arguments),*))
            }
            On::Mechanism(of) => {
                let name = ident(name);
                quote!(__rt::Mechanism::#name(#of #(, #arguments)*))
            }
            On::Runtime => {
                let name = runtime(name);
                quote!(#name(#(#arguments),*))
            }
        }
    }

    fn function(&self, of: Option<&Type>, name: &str) -> TokenStream {
        match of {
            Some(of) => {
                let (of, name) = (path(of), ident(name));
                quote!(#of::#name)
            }
            None => runtime(name),
        }
    }

    fn tried(&self, value: TokenStream) -> TokenStream {
        quote!(#value?)
    }

    fn borrowed(&self, value: TokenStream) -> TokenStream {
        quote!(&#value)
    }

    fn mutably_borrowed(&self, value: TokenStream) -> TokenStream {
        quote!(&mut #value)
    }

    fn dereferenced(&self, value: TokenStream) -> TokenStream {
        quote!(*#value)
    }

    fn reference_binding(&self, _of: Binding) -> Binding {
        Binding::Prefix
    }

    fn closure(
        &self,
        arguments: Vec<TokenStream>,
        statements: Vec<TokenStream>,
        value: TokenStream,
        moves: bool,
    ) -> TokenStream {
        let moves = moves.then(|| quote!(move));
        let body = if statements.is_empty() { value } else { quote!({ #(#statements)* #value }) };
        quote!(#moves |#(#arguments),*| #body)
    }

    fn block(&self, statements: Vec<TokenStream>, value: Option<TokenStream>) -> TokenStream {
        quote!({ #(#statements)* #value })
    }

    fn let_statement(&self, pattern: TokenStream, value: TokenStream) -> TokenStream {
        quote!(let #pattern = #value;)
    }

    fn do_statement(&self, value: TokenStream) -> TokenStream {
        quote!(#value;)
    }

    fn assignment(&self, to: TokenStream, value: TokenStream) -> TokenStream {
        quote!(#to = #value;)
    }

    fn return_statement(&self, value: TokenStream) -> TokenStream {
        quote!(return #value;)
    }

    fn let_else(&self, pattern: TokenStream, value: TokenStream, otherwise: TokenStream) -> TokenStream {
        quote!(let #pattern = #value else { return #otherwise; };)
    }

    fn unless(&self, conditions: Vec<TokenStream>, inside: Vec<TokenStream>) -> TokenStream {
        match conditions.as_slice() {
            [only] => quote!(if !#only { #(#inside)* }),
            several => quote!(if !(#(#several)&&*) { #(#inside)* }),
        }
    }

    fn ignored(&self) -> TokenStream {
        quote!(_)
    }

    fn mutable(&self, name: TokenStream) -> TokenStream {
        quote!(mut #name)
    }

    fn case(&self, case: Intrinsic, inside: TokenStream) -> TokenStream {
        let case = runtime(case.row().name);
        quote!(#case(#inside))
    }

    fn typed(&self, name: TokenStream, of: &Type) -> TokenStream {
        let of = tokens(of);
        quote!(#name: #of)
    }

    fn struct_pattern(&self, of: &Type, fields: Vec<Member<TokenStream>>, is_whole: bool) -> TokenStream {
        let of = path(of);
        let fields = fields.into_iter().map(|(name, pattern)| {
            let name = ident(&name);
            pattern.map_or_else(|| quote!(#name,), |pattern| quote!(#name: #pattern,))
        });
        let rest = (!is_whole).then(|| quote!(..));
        quote!(#of { #(#fields)* #rest })
    }
}

/// The name of a field, or its index in a tuple.
fn member(name: &str) -> TokenStream {
    match name.parse::<usize>() {
        Ok(index) => literal(index).into_token_stream(),
        Err(_) => ident(name).into_token_stream(),
    }
}

/// A path of the runtime.
fn runtime(path: &str) -> TokenStream {
    let path = parsed(path);
    quote!(__rt::#path)
}

fn parsed(path: &str) -> TokenStream {
    path.parse().unwrap_or_default()
}

/// A type as it is written in emitted code.
#[must_use]
pub fn tokens(of: &Type) -> TokenStream {
    match of {
        Type::Scalar => quote!(T),
        Type::Text => quote!(&'static str),
        Type::Flag => quote!(bool),
        Type::Count => quote!(usize),
        Type::Lanes => quote!([T; W]),
        Type::Itself => quote!(Self),
        Type::OfTrait(name) => {
            let name = ident(name);
            quote!(Self::#name)
        }
        Type::Own(name) => {
            let name = ident(name);
            quote!(#name<T>)
        }
        Type::Wide(name) => {
            let name = ident(name);
            quote!(#name<__rt::Wide>)
        }
        Type::Bare(name) => ident(name).into_token_stream(),
        Type::Each(name, item) => {
            let (name, item) = (ident(name), tokens(item));
            quote!(#name<#item>)
        }
        Type::Vector(rows) => {
            let rows = literal(*rows);
            quote!(__rt::SVector<T, #rows>)
        }
        Type::Matrix(rows, columns) => {
            let (rows, columns) = (literal(*rows), literal(*columns));
            quote!(__rt::SMatrix<T, #rows, #columns>)
        }
        Type::Point => quote!(__rt::Point2<T>),
        Type::Plane => quote!(__rt::Vector2<T>),
        Type::Runtime(name, sizes) => {
            let (name, sizes) = (runtime(name), sizes.iter().map(|size| literal(*size)));
            quote!(#name<T #(, #sizes)*>)
        }
        Type::Sized(name, sizes) => {
            let (name, sizes) = (runtime(name), sizes.iter().map(|size| literal(*size)));
            quote!(#name<T #(, __rt::D<#sizes>)*>)
        }
        Type::Around(name, item) => {
            let (name, item) = (runtime(name), tokens(item));
            quote!(#name<#item>)
        }
        Type::List(item, count) => {
            let (item, count) = (tokens(item), literal(*count));
            quote!([#item; #count])
        }
        Type::Column(item, count) => {
            let (item, count) = (tokens(item), literal(*count));
            quote!(__rt::Column<#item, __rt::D<#count>>)
        }
        Type::Tuple(items) => {
            let items = items.iter().map(tokens);
            quote!((#(#items),*))
        }
        Type::ReducedMotion { pose, rates, unknowns, inputs } => {
            let [pose, rates] = [pose, rates].map(|name| ident(name));
            let [unknowns, inputs] = [unknowns, inputs].map(|count| literal(*count));
            quote!(__rt::ReducedMotion<#pose<T>, #rates<T>, T, #unknowns, #inputs>)
        }
        Type::StateRates { rates, inputs } => {
            let [rates, inputs] = [rates, inputs].map(|name| ident(name));
            quote!(__rt::StateRates<#rates<T>, #inputs<T>>)
        }
        Type::Branches { branch, pose } => {
            let (branch, pose) = (ident(branch), ident(pose));
            quote!(impl __rt::Iterator<Item = __rt::Assembled<#branch, #pose<T>>> + '_)
        }
        Type::Iterator { item, is_cloned } => {
            let (item, clone) = (tokens(item), is_cloned.then(|| quote!(+ __rt::Clone)));
            quote!(impl __rt::Iterator<Item = #item> #clone)
        }
    }
}

/// A type as a path in expressions and patterns, without generic arguments.
fn path(of: &Type) -> TokenStream {
    match of {
        Type::Own(name) | Type::Bare(name) | Type::Each(name, _) => ident(name).into_token_stream(),
        Type::Runtime(name, _) | Type::Sized(name, _) => runtime(name),
        Type::List(..) => {
            let of = tokens(of);
            quote!(<#of>)
        }
        other => tokens(other),
    }
}

/// The name of an argument: with an underscore if the body ignores it.
pub(super) fn argument(name: &str, is_used: bool) -> Ident {
    if is_used { ident(name) } else { ident(&format!("_{name}")) }
}
