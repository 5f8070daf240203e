//! Expressions, patterns, statements and types of a program as Rust.

use std::f64::consts::PI;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::names::{ident, string};
use crate::graph::{Function, Number};
use crate::program::{Expression, Pattern, Statement, Type};

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

impl ToTokens for Expression {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        written(self).to_tokens(tokens);
    }
}

/// An expression, in parentheses if it binds less tightly than `at_least`.
fn operand(value: &Expression, at_least: Binding) -> TokenStream {
    let tokens = written(value);
    if binding(value) < at_least { quote!((#tokens)) } else { tokens }
}

/// The precedence of an expression.
fn binding(value: &Expression) -> Binding {
    match value {
        Expression::Sum(_) | Expression::All(_) | Expression::Closure { .. } => Binding::Sum,
        Expression::Product(_) | Expression::Quotient(_) | Expression::Square(_) => Binding::Product,
        Expression::Number(number) if parts_of_pi(*number).is_some() => Binding::Product,
        Expression::Exact(number) if is_long(*number) => Binding::Product,
        // -a * b parses as (-a) * b, which is equal and costs the same.
        Expression::Negative(inside) => match binding(inside) {
            Binding::Product => Binding::Product,
            _ => Binding::Prefix,
        },
        Expression::Borrowed(_) | Expression::MutablyBorrowed(_) | Expression::Dereferenced(_) => Binding::Prefix,
        _ => Binding::Atom,
    }
}

fn written(value: &Expression) -> TokenStream {
    match value {
        Expression::Name(name) => ident(name).into_token_stream(),
        Expression::Number(number) => turn(*number).unwrap_or_else(|| constant(*number)),
        Expression::Exact(number) => exact(*number),
        Expression::Sum(terms) => sum(terms),
        Expression::Product(factors) => {
            let mut factors = factors.iter();
            let first = factors.next().map(|factor| operand(factor, Binding::Product));
            let others = factors.map(|factor| operand(factor, Binding::Prefix));
            quote!(#first #(* #others)*)
        }
        Expression::Quotient(parts) => {
            let (above, below) = (operand(&parts[0], Binding::Product), operand(&parts[1], Binding::Prefix));
            quote!(#above / #below)
        }
        // The operand is a name or a number: lowering gives all others a line.
        Expression::Square(base) => {
            let (left, right) = (operand(base, Binding::Product), operand(base, Binding::Prefix));
            quote!(#left * #right)
        }
        Expression::Negative(inside) => {
            let inside = operand(inside, Binding::Product);
            quote!(-#inside)
        }
        Expression::Elementary(function, arguments) => {
            let name = ident(method(*function));
            let first = arguments.first().map(|first| operand(first, Binding::Atom));
            let others = arguments.iter().skip(1);
            quote!(#first.#name(#(#others),*))
        }
        Expression::All(conditions) if conditions.is_empty() => quote!(true),
        Expression::All(conditions) => quote!(#(#conditions)&*),
        Expression::Text(text) => string(text).into_token_stream(),
        Expression::Count(count) => literal(*count).into_token_stream(),
        Expression::Constant("false") => quote!(false),
        Expression::Constant(path) if path.starts_with("Self::") => parsed(path),
        Expression::Constant(path) => runtime(path),
        Expression::Field(of, name) => {
            let (of, name) = (operand(of, Binding::Atom), member(name));
            quote!(#of.#name)
        }
        Expression::Index(of, place) => {
            let (of, place) = (operand(of, Binding::Atom), literal(*place));
            quote!(#of[#place])
        }
        Expression::At(parts) => {
            let (of, place) = (operand(&parts[0], Binding::Atom), &parts[1]);
            quote!(#of[#place])
        }
        Expression::List(values) => quote!([#(#values),*]),
        Expression::Repeated(value, count) => {
            let count = literal(*count);
            quote!([#value; #count])
        }
        Expression::Tuple(values) => match values.as_slice() {
            [only] => quote!((#only,)),
            _ => quote!((#(#values),*)),
        },
        Expression::Struct(of, members, rest) => {
            let of = path(of);
            let mut members: Vec<TokenStream> = members.iter().map(|(name, value)| field(name, value)).collect();
            members.extend(rest.iter().map(|rest| quote!(..#rest)));
            quote!(#of { #(#members),* })
        }
        Expression::Runtime(name, arguments) => {
            let name = runtime(name);
            quote!(#name(#(#arguments),*))
        }
        Expression::Associated(of, name, arguments) => {
            let (of, name) = (path(of), ident(name));
            quote!(#of::#name(#(#arguments),*))
        }
        Expression::Function(of, name) => {
            let (of, name) = (path(of), ident(name));
            quote!(#of::#name)
        }
        Expression::Method(of, name, arguments) => {
            let (of, name) = (operand(of, Binding::Atom), ident(name));
            quote!(#of.#name(#(#arguments),*))
        }
        Expression::Try(value) => {
            let value = operand(value, Binding::Atom);
            quote!(#value?)
        }
        Expression::Borrowed(value) => {
            let value = operand(value, Binding::Prefix);
            quote!(&#value)
        }
        Expression::MutablyBorrowed(value) => {
            let value = operand(value, Binding::Prefix);
            quote!(&mut #value)
        }
        Expression::Dereferenced(value) => {
            let value = operand(value, Binding::Prefix);
            quote!(*#value)
        }
        Expression::Closure { arguments, statements, value, moves } => {
            let moves = moves.then(|| quote!(move));
            let body = match statements.as_slice() {
                [] => quote!(#value),
                _ => quote!({ #(#statements)* #value }),
            };
            quote!(#moves |#(#arguments),*| #body)
        }
        Expression::Block(statements, value) => match &**value {
            Expression::Tuple(values) if values.is_empty() => quote!({ #(#statements)* }),
            value => quote!({ #(#statements)* #value }),
        },
        // Lowering has replaced these.
        Expression::Result(place) | Expression::Local(place) => literal(*place).into_token_stream(),
    }
}

fn sum(terms: &[(bool, Expression)]) -> TokenStream {
    let mut tokens = TokenStream::new();
    for (place, (is_negative, term)) in terms.iter().enumerate() {
        let least = if place == 0 && !is_negative { Binding::Sum } else { Binding::Product };
        let term = operand(term, least);
        tokens.extend(match (place, is_negative) {
            (0, false) => term,
            (_, true) => quote!(- #term),
            (_, false) => quote!(+ #term),
        });
    }
    tokens
}

/// `name: value`, or `name` alone if the value has this name.
fn field(name: &str, value: &Expression) -> TokenStream {
    let is_short = matches!(value, Expression::Name(other) if other == name);
    let name = member(name);
    if is_short { quote!(#name) } else { quote!(#name: #value) }
}

/// The name of a field, or its index in a tuple.
fn member(name: &str) -> TokenStream {
    match name.parse::<usize>() {
        Ok(place) => literal(place).into_token_stream(),
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

impl ToTokens for Statement {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(match self {
            Self::Let(pattern, value) => quote!(let #pattern = #value;),
            Self::Do(value) => quote!(#value;),
            Self::Assign(place, value) => quote!(#place = #value;),
            Self::Return(value) => quote!(return #value;),
            Self::LetElse(pattern, value, otherwise) => {
                quote!(let #pattern = #value else { return #otherwise; };)
            }
            Self::Unless(conditions, inside) => match conditions.as_slice() {
                [only] => quote!(if !#only { #(#inside)* }),
                several => quote!(if !(#(#several)&&*) { #(#inside)* }),
            },
            // Lowering has replaced these by calls.
            Self::Check { .. }
            | Self::CheckPosition
            | Self::CheckKinematics { .. }
            | Self::LetAccepted(..)
            | Self::LetPassed(_)
            | Self::Refine(..) => TokenStream::new(),
        });
    }
}

impl ToTokens for Pattern {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(match self {
            Self::Name(name) => ident(name).into_token_stream(),
            Self::Mutable(inside) => quote!(mut #inside),
            Self::Case(case, inside) => {
                let case = ident(case);
                quote!(__rt::#case(#inside))
            }
            Self::Typed(name, of) => {
                let name = ident(name);
                quote!(#name: #of)
            }
            Self::Ignored | Self::Local(_) => quote!(_),
            Self::List(patterns) => quote!([#(#patterns),*]),
            Self::Tuple(patterns) => quote!((#(#patterns),*)),
            Self::Struct { of, fields, is_whole } => {
                let of = path(of);
                let fields = fields.iter().map(|(field, pattern)| {
                    let is_name = matches!(pattern, Self::Name(name) if name == field);
                    let field = ident(field);
                    if is_name { quote!(#field,) } else { quote!(#field: #pattern,) }
                });
                let rest = (!is_whole).then(|| quote!(..));
                quote!(#of { #(#fields)* #rest })
            }
        });
    }
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
            Self::Kinematics { pose, rates, unknowns, inputs } => {
                let [pose, rates] = [pose, rates].map(|name| ident(name));
                let [unknowns, inputs] = [unknowns, inputs].map(|count| literal(*count));
                quote!(__rt::Kinematics<#pose<T>, #rates<T>, T, #unknowns, #inputs>)
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
pub(super) fn parts_of_pi(number: Number) -> Option<(f64, f64)> {
    let Number::Float(value) = number else { return None };
    // 180 parts are whole degrees; finer fractions of pi are written as decimals.
    (1..=180_u32).map(f64::from).find_map(|parts| {
        let count = (value / PI * parts).round();
        let same = count != 0.0 && (count * PI / parts - value).abs() <= 4.0 * f64::EPSILON * value.abs();
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
        Function::Hypot => "hypotenuse",
        _ => function.operation().name,
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

/// A float literal with its decimals in groups of three.
fn separated(value: f64) -> TokenStream {
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
