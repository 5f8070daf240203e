//! Lowered code, types and numbers as Rust.

use std::f64::consts::PI;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::names::{ident, string};
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
        turn(number).unwrap_or_else(|| constant(number))
    }

    fn number_binding(&self, number: Number) -> Binding {
        if parts_of_pi(number).is_some() { Binding::Product } else { Binding::Atom }
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
        let name = ident(method(function));
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

/// An integer literal without suffix.
pub(super) fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// A path of the runtime.
fn runtime(path: &str) -> TokenStream {
    let path = parsed(path);
    quote!(__rt::#path)
}

fn parsed(path: &str) -> TokenStream {
    path.parse().unwrap_or_default()
}

impl ToTokens for Type {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(match self {
            Self::Scalar => quote!(T),
            Self::Text => quote!(&'static str),
            Self::Flag => quote!(bool),
            Self::Count => quote!(usize),
            Self::Lanes => quote!([T; W]),
            Self::Itself => quote!(Self),
            Self::OfTrait(name) => {
                let name = ident(name);
                quote!(Self::#name)
            }
            Self::Own(name) => {
                let name = ident(name);
                quote!(#name<T>)
            }
            Self::Wide(name) => {
                let name = ident(name);
                quote!(#name<__rt::Wide>)
            }
            Self::Bare(name) => ident(name).into_token_stream(),
            Self::Each(name, item) => {
                let name = ident(name);
                quote!(#name<#item>)
            }
            Self::Vector(rows) => {
                let rows = literal(*rows);
                quote!(__rt::SVector<T, #rows>)
            }
            Self::Matrix(rows, columns) => {
                let (rows, columns) = (literal(*rows), literal(*columns));
                quote!(__rt::SMatrix<T, #rows, #columns>)
            }
            Self::Point => quote!(__rt::Point2<T>),
            Self::Plane => quote!(__rt::Vector2<T>),
            Self::Runtime(name, sizes) => {
                let (name, sizes) = (runtime(name), sizes.iter().map(|size| literal(*size)));
                quote!(#name<T #(, #sizes)*>)
            }
            Self::Sized(name, sizes) => {
                let (name, sizes) = (runtime(name), sizes.iter().map(|size| literal(*size)));
                quote!(#name<T #(, __rt::D<#sizes>)*>)
            }
            Self::Around(name, item) => {
                let name = runtime(name);
                quote!(#name<#item>)
            }
            Self::List(item, count) => {
                let count = literal(*count);
                quote!([#item; #count])
            }
            Self::Column(item, count) => {
                let count = literal(*count);
                quote!(__rt::Column<#item, __rt::D<#count>>)
            }
            Self::Tuple(items) => quote!((#(#items),*)),
            Self::ReducedMotion { pose, rates, unknowns, inputs } => {
                let [pose, rates] = [pose, rates].map(|name| ident(name));
                let [unknowns, inputs] = [unknowns, inputs].map(|count| literal(*count));
                quote!(__rt::ReducedMotion<#pose<T>, #rates<T>, T, #unknowns, #inputs>)
            }
            Self::StateRates { rates, inputs } => {
                let [rates, inputs] = [rates, inputs].map(|name| ident(name));
                quote!(__rt::StateRates<#rates<T>, #inputs<T>>)
            }
            Self::Branches { branch, pose } => {
                let (branch, pose) = (ident(branch), ident(pose));
                quote!(impl __rt::Iterator<Item = __rt::Assembled<#branch, #pose<T>>> + '_)
            }
            Self::Iterator { item, is_cloned } => {
                let clone = is_cloned.then(|| quote!(+ __rt::Clone));
                quote!(impl __rt::Iterator<Item = #item> #clone)
            }
        });
    }
}

/// A type as a path in expressions and patterns, without generic arguments.
fn path(of: &Type) -> TokenStream {
    match of {
        Type::Own(name) | Type::Bare(name) | Type::Each(name, _) => ident(name).into_token_stream(),
        Type::Runtime(name, _) | Type::Sized(name, _) => runtime(name),
        Type::List(..) => quote!(<#of>),
        other => other.to_token_stream(),
    }
}

/// The name of an argument: with an underscore if the body ignores it.
pub(super) fn argument(name: &str, is_used: bool) -> Ident {
    if is_used { ident(name) } else { ident(&format!("_{name}")) }
}

/// (count, parts) if the number is count * pi / parts with parts up to 180.
pub fn parts_of_pi(number: Number) -> Option<(f64, f64)> {
    /// Fractions with larger counts are so close together that any number is near one.
    const MOST: f64 = 1e6;
    let Number::Float(value) = number else { return None };
    // 180 parts are whole degrees; finer fractions of pi are written as decimals.
    (1..=180_u32).map(f64::from).find_map(|parts| {
        let count = (value / PI * parts).round();
        let same = count != 0.0
            && count.abs() < MOST
            && (count * PI / parts - value).abs() <= 4.0 * f64::EPSILON * value.abs();
        same.then_some((count, parts))
    })
}

/// A multiple of pi as an expression: `pi / 2` instead of 1.5707….
fn turn(number: Number) -> Option<TokenStream> {
    let (count, parts) = parts_of_pi(number)?;
    let (n, d) = (Literal::f64_unsuffixed(count), Literal::f64_unsuffixed(parts));
    Some(match (count == 1.0, parts == 1.0) {
        (true, true) => quote!(T::pi()),
        (true, false) => quote!(T::pi() / __rt::real::<T>(#d)),
        (false, true) => quote!(T::pi() * __rt::real::<T>(#n)),
        (false, false) => quote!(T::pi() * __rt::real::<T>(#n) / __rt::real::<T>(#d)),
    })
}

/// A constant as an `f64`.
pub(super) fn plain(number: Number) -> TokenStream {
    let magnitude = number.absolute();
    let tokens = match parts_of_pi(magnitude) {
        Some((count, parts)) => {
            let (n, d) = (Literal::f64_unsuffixed(count), Literal::f64_unsuffixed(parts));
            quote!(::core::f64::consts::PI * #n / #d)
        }
        None => separated(magnitude.to_f64()),
    };
    if number.is_negative() { quote!(-#tokens) } else { tokens }
}

/// The method of the runtime's `Real`, or of nalgebra's `RealField`, that computes a function.
fn method(function: Function) -> &'static str {
    match function {
        Function::Sin => "sine",
        Function::Cos => "cosine",
        Function::Atan2 => "arctangent2",
        Function::Tan => "tangent",
        Function::Asin => "arcsine",
        Function::Acos => "arccosine",
        Function::Atan => "arctangent",
        Function::Exp => "exponential",
        Function::Ln => "logarithm",
        Function::Hypot => "hypotenuse",
        Function::Sqrt | Function::Abs | Function::IfNonzero => function.operation().name,
    }
}

/// A constant as a scalar of any type.
pub(super) fn constant(number: Number) -> TokenStream {
    match number {
        // A `Number::Float` can be zero, too.
        number if number.is_zero() => quote!(T::zero()),
        Number::Ratio(1, 1) => quote!(T::one()),
        Number::Ratio(n, d) => {
            let value = n as f64 / d as f64;
            // A ratio that is not a short decimal is written as a quotient.
            let short = format!("{value}").len() <= 8;
            let (n, d) = (Literal::f64_unsuffixed(n as f64), Literal::f64_unsuffixed(d as f64));
            if short {
                let value = Literal::f64_unsuffixed(value);
                quote!(__rt::real::<T>(#value))
            } else {
                quote!(__rt::real::<T>(#n / #d))
            }
        }
        Number::Float(value) => {
            let literal = separated(value);
            quote!(__rt::real::<T>(#literal))
        }
    }
}

/// True if a part of this ratio is no double, so that it is a quotient of two numbers.
fn is_long(number: Number) -> bool {
    matches!(number, Number::Ratio(_, d) if d != 1 && number.as_quotient().is_none())
}

/// A constant as a number of any kind: a ratio exactly.
fn exact(number: Number) -> TokenStream {
    let plain = Literal::f64_unsuffixed;
    match (number, number.as_quotient()) {
        // Dividing a double by a power of two is exact.
        (Number::Ratio(_, d), Some([above, below])) if d.count_ones() == 1 => {
            let value = plain(above / below);
            quote!(T::exactly(#value))
        }
        (_, Some([above, below])) => {
            let (above, below) = (plain(above), plain(below));
            quote!(T::ratio(#above, #below))
        }
        (Number::Ratio(n, d), None) if d != 1 => {
            let (n, d) = (plain(n as f64), plain(d as f64));
            quote!(T::near(#n) / T::near(#d))
        }
        _ => {
            let value = separated(number.to_f64());
            quote!(T::near(#value))
        }
    }
}

/// An integer literal with its digits in groups of three.
pub(super) fn separated_integer(value: u64) -> TokenStream {
    let text = value.to_string();
    let groups: Vec<&[u8]> = text.as_bytes().rchunks(3).rev().collect();
    let groups: Vec<_> = groups.into_iter().map(String::from_utf8_lossy).collect();
    parsed(&groups.join("_"))
}

/// A float literal with its decimals in groups of three.
pub(super) fn separated(value: f64) -> TokenStream {
    let text = format!("{value:?}");
    let grouped = match text.split_once('.') {
        Some((whole, fraction)) if !text.contains('e') => {
            let groups: Vec<String> =
                fraction.as_bytes().chunks(3).map(|group| String::from_utf8_lossy(group).into_owned()).collect();
            format!("{whole}.{}", groups.join("_"))
        }
        _ => text,
    };
    grouped.parse().unwrap_or_else(|_| {
        let literal = Literal::f64_unsuffixed(value);
        quote!(#literal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_of_pi_have_small_counts() {
        let fractions = [(1.0, 1.0), (2.0, 3.0), (7.0, 180.0), (999_999.0, 1.0)];
        for (count, parts) in fractions {
            assert_eq!(parts_of_pi(Number::Float(count * PI / parts)), Some((count, parts)));
        }
        for large in [1e17, 1e154, 1e300] {
            assert_eq!(parts_of_pi(Number::Float(large)), None);
        }
    }
}
