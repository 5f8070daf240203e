//! Values of a schedule as Rust expressions.

use std::f64::consts::PI;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::names::{Names, ident};
use crate::graph::{Function, Number};
use crate::simplify::schedule::{Schedule, Signed, Value, ValueId};

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

/// A value, by its name if it has one.
pub(super) fn signed(names: &mut Names, schedule: &Schedule, value: Signed) -> TokenStream {
    operand(names, schedule, value, Binding::Sum)
}

/// How a value is computed, even if it has a name.
pub(super) fn definition(names: &mut Names, schedule: &Schedule, value: ValueId) -> TokenStream {
    compute(names, schedule, value).0
}

fn operand(names: &mut Names, schedule: &Schedule, value: Signed, at_least: Binding) -> TokenStream {
    let name = names.get(schedule, value.value);
    // -(a - b) is b - a.
    if let (true, None, Value::Sum(terms)) = (value.negative, &name, schedule.value(value.value))
        && terms.iter().any(|term| term.negative)
    {
        let mut terms: Vec<Signed> =
            terms.iter().map(|term| Signed { negative: !term.negative, value: term.value }).collect();
        terms.sort_by_key(|term| term.negative);
        let tokens = sum(names, schedule, &terms);
        return if at_least > Binding::Sum { quote!((#tokens)) } else { tokens };
    }
    let (tokens, binding) = match name {
        Some(name) => {
            let name = ident(&name);
            (quote!(#name), Binding::Atom)
        }
        None => compute(names, schedule, value.value),
    };
    let (tokens, binding) = match (value.negative, schedule.value(value.value)) {
        (false, _) => (tokens, binding),
        (true, Value::Constant(number)) if number.is_zero() => (tokens, binding),
        // -a * b is (-a) * b: a minus binds tighter than a product and costs the same.
        (true, _) if binding >= Binding::Product => (quote!(-#tokens), binding.min(Binding::Prefix)),
        (true, _) => (quote!(-(#tokens)), Binding::Prefix),
    };
    if binding < at_least { quote!((#tokens)) } else { tokens }
}

fn sum(names: &mut Names, schedule: &Schedule, terms: &[Signed]) -> TokenStream {
    let mut tokens = operand(names, schedule, terms[0], Binding::Sum);
    for term in &terms[1..] {
        let body = operand(names, schedule, Signed { negative: false, value: term.value }, Binding::Product);
        tokens = if term.negative { quote!(#tokens - #body) } else { quote!(#tokens + #body) };
    }
    tokens
}

fn compute(names: &mut Names, schedule: &Schedule, value: ValueId) -> (TokenStream, Binding) {
    let plain = |value: ValueId| Signed { negative: false, value };
    match schedule.value(value) {
        Value::Constant(number) => match turn(*number) {
            Some(angle) => (angle, Binding::Product),
            None => (constant(*number), Binding::Atom),
        },
        Value::Symbol(symbol) => {
            let name = ident(&names.symbol(*symbol));
            (quote!(#name), Binding::Atom)
        }
        // Given directions are named before any expression is written.
        Value::Direction(..) => (quote!(direction), Binding::Atom),
        Value::Sum(terms) => (sum(names, schedule, terms), Binding::Sum),
        Value::Product(factors) => {
            let mut tokens = operand(names, schedule, plain(factors[0]), Binding::Product);
            for factor in &factors[1..] {
                let body = operand(names, schedule, plain(*factor), Binding::Prefix);
                tokens = quote!(#tokens * #body);
            }
            (tokens, Binding::Product)
        }
        Value::Quotient(above, below) => {
            let above = operand(names, schedule, plain(*above), Binding::Product);
            let below = operand(names, schedule, plain(*below), Binding::Prefix);
            (quote!(#above / #below), Binding::Product)
        }
        Value::Square(base) => {
            let named = names.get(schedule, *base).is_some();
            let base = operand(names, schedule, plain(*base), Binding::Atom);
            if named { (quote!(#base * #base), Binding::Product) } else { (quote!(#base.powi(2)), Binding::Atom) }
        }
        Value::Call(function, arguments) => {
            let receiver = operand(names, schedule, arguments[0], Binding::Atom);
            let method = ident(function.operation().method);
            let rest: Vec<_> =
                arguments[1..].iter().map(|argument| operand(names, schedule, *argument, Binding::Sum)).collect();
            (quote!(#receiver.#method(#(#rest),*)), Binding::Atom)
        }
    }
}

/// count * pi / parts, if the number is a multiple of pi that somebody would write.
fn parts_of_pi(number: Number) -> Option<(f64, f64)> {
    let Number::Float(value) = number else { return None };
    // Finer than a degree nobody writes an angle as a part of pi.
    (1..=180_u32).map(f64::from).find_map(|parts| {
        let count = (value / PI * parts).round();
        let same = count != 0.0 && (count * PI / parts - value).abs() <= 4.0 * f64::EPSILON * value.abs();
        same.then_some((count, parts))
    })
}

/// A multiple of pi, as people write it: pi / 2, not 1.5707….
fn turn(number: Number) -> Option<TokenStream> {
    let (count, parts) = parts_of_pi(number)?;
    let (n, d) = (Literal::f64_unsuffixed(count), Literal::f64_unsuffixed(parts));
    Some(match (count == 1.0, parts == 1.0) {
        (true, true) => quote!(T::pi()),
        (true, false) => quote!(T::pi() / real::<T>(#d)),
        (false, true) => quote!(T::pi() * real::<T>(#n)),
        (false, false) => quote!(T::pi() * real::<T>(#n) / real::<T>(#d)),
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

/// A constant as a scalar of any type.
pub(super) fn constant(number: Number) -> TokenStream {
    match number {
        Number::Ratio(0, _) => quote!(T::zero()),
        Number::Ratio(1, 1) => quote!(T::one()),
        Number::Ratio(n, d) => {
            let value = n as f64 / d as f64;
            // A ratio that is not a short decimal is written as the ratio it is.
            let short = format!("{value}").len() <= 8;
            let (n, d) = (Literal::f64_unsuffixed(n as f64), Literal::f64_unsuffixed(d as f64));
            if short {
                let value = Literal::f64_unsuffixed(value);
                quote!(real::<T>(#value))
            } else {
                quote!(real::<T>(#n / #d))
            }
        }
        Number::Float(value) => {
            let literal = separated(value);
            quote!(real::<T>(#literal))
        }
    }
}

/// A float with its digits in groups of three, as people read them.
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

/// The name of the sine or cosine of a direction.
pub(super) fn direction_name(function: Function, angle: &str) -> String {
    format!("{}_{angle}", function.operation().name)
}
