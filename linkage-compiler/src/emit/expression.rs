//! Values of a schedule as Rust expressions.

use std::f64::consts::PI;

use proc_macro2::{Delimiter, Literal, TokenStream, TokenTree};
use quote::quote;

use super::names::Names;
use super::tokens::Tokens;
use crate::graph::{Function, Number};
use crate::lower::{Schedule, Signed, Value, ValueId};

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Prefix,
    Atom,
}

/// A value, by its name if it has one.
pub(super) fn signed(names: &Names, schedule: &Schedule, value: Signed) -> Tokens {
    let mut tokens = Tokens::default();
    write(&mut tokens, names, schedule, value);
    tokens
}

/// Writes a value, by its name if it has one.
pub(super) fn write(tokens: &mut Tokens, names: &Names, schedule: &Schedule, value: Signed) {
    operand(tokens, names, schedule, value, Binding::Sum);
}

/// Writes how a value is computed, even if it has a name.
pub(super) fn define(tokens: &mut Tokens, names: &Names, schedule: &Schedule, value: ValueId) {
    compute(tokens, names, schedule, value);
}

fn operand(tokens: &mut Tokens, names: &Names, schedule: &Schedule, value: Signed, at_least: Binding) {
    let name = names.get(schedule, value.value);
    let definition = schedule.value(value.value);
    // -(a - b) is b - a.
    let flipped = match definition {
        Value::Sum(terms) if value.negative && name.is_none() && terms.iter().any(|term| term.negative) => Some(terms),
        _ => None,
    };
    let inner = if name.is_some() { Binding::Atom } else { binding(names, schedule, value.value) };
    let zero = matches!(definition, Value::Constant(number) if number.is_zero());
    let negative = value.negative && !zero && flipped.is_none();
    // -a * b is (-a) * b: a minus binds tighter than a product and costs the same.
    let bracketed = negative && inner < Binding::Product;
    let outer = match (negative, bracketed) {
        (false, _) => inner,
        (true, true) => Binding::Prefix,
        (true, false) => inner.min(Binding::Prefix),
    };
    let inside = |tokens: &mut Tokens| match (name, flipped) {
        (Some(name), _) => tokens.ident(&name.ident),
        (None, Some(terms)) => {
            let flip = |term: &Signed| Signed { negative: !term.negative, value: term.value };
            let mut terms: Vec<Signed> = terms.iter().map(flip).collect();
            terms.sort_by_key(|term| term.negative);
            sum(tokens, names, schedule, &terms);
        }
        (None, None) => compute(tokens, names, schedule, value.value),
    };
    // Most operands stand without brackets.
    if outer >= at_least && !bracketed {
        if negative {
            tokens.punct('-');
        }
        inside(tokens);
        return;
    }
    within(tokens, outer < at_least, |tokens| {
        if negative {
            tokens.punct('-');
        }
        within(tokens, bracketed, inside);
    });
}

/// Writes in brackets, or without.
fn within(tokens: &mut Tokens, brackets: bool, write: impl FnOnce(&mut Tokens)) {
    if brackets {
        let mut inside = Tokens::default();
        write(&mut inside);
        tokens.group(Delimiter::Parenthesis, inside);
    } else {
        write(tokens);
    }
}

fn sum(tokens: &mut Tokens, names: &Names, schedule: &Schedule, terms: &[Signed]) {
    operand(tokens, names, schedule, terms[0], Binding::Sum);
    for term in &terms[1..] {
        tokens.punct(if term.negative { '-' } else { '+' });
        operand(tokens, names, schedule, Signed { negative: false, value: term.value }, Binding::Product);
    }
}

/// How tightly the definition of a value binds.
fn binding(names: &Names, schedule: &Schedule, value: ValueId) -> Binding {
    match schedule.value(value) {
        Value::Sum(_) => Binding::Sum,
        Value::Product(_) | Value::Quotient(..) => Binding::Product,
        Value::Constant(number) if parts_of_pi(*number).is_some() => Binding::Product,
        Value::Square(base) if names.get(schedule, *base).is_some() => Binding::Product,
        _ => Binding::Atom,
    }
}

fn compute(tokens: &mut Tokens, names: &Names, schedule: &Schedule, value: ValueId) {
    let part = |tokens: &mut Tokens, value: ValueId, at_least: Binding| {
        operand(tokens, names, schedule, Signed { negative: false, value }, at_least);
    };
    match schedule.value(value) {
        Value::Constant(number) => {
            let written = names.constant(*number, |number| turn(number).unwrap_or_else(|| constant(number)));
            // Zero, one and parts of a turn are constants of the scalar itself.
            if written.clone().into_iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "real")) {
                names.take_number();
            }
            tokens.extend(written);
        }
        Value::Symbol(symbol) => tokens.append(names.symbol(*symbol)),
        // Given directions are named before any expression is written.
        Value::Direction(..) => tokens.word("direction"),
        // Calls of the user's functions have lines of their own.
        Value::External(..) => tokens.word("external"),
        Value::Sum(terms) => sum(tokens, names, schedule, terms),
        Value::Product(factors) => {
            part(tokens, factors[0], Binding::Product);
            for &factor in &factors[1..] {
                tokens.punct('*');
                part(tokens, factor, Binding::Prefix);
            }
        }
        Value::Quotient(above, below) => {
            part(tokens, *above, Binding::Product);
            tokens.punct('/');
            part(tokens, *below, Binding::Prefix);
        }
        Value::Square(base) => {
            part(tokens, *base, Binding::Atom);
            if names.get(schedule, *base).is_some() {
                tokens.punct('*');
                part(tokens, *base, Binding::Atom);
            } else {
                tokens.extend(quote!(.powi(2)));
            }
        }
        Value::Call(function, arguments) => {
            operand(tokens, names, schedule, arguments[0], Binding::Atom);
            tokens.punct('.');
            tokens.word(function.operation().method);
            let mut inside = Tokens::default();
            for (index, argument) in arguments[1..].iter().enumerate() {
                if index > 0 {
                    inside.punct(',');
                }
                write(&mut inside, names, schedule, *argument);
            }
            tokens.group(Delimiter::Parenthesis, inside);
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
        // A float may be zero as well, as the magnitude of one is.
        number if number.is_zero() => quote!(T::zero()),
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
    [function.operation().name, "_", angle].concat()
}
