//! Numbers as Rust: literals, ratios, multiples of pi.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::graph::Number;
use crate::lower::parts_of_pi;

/// An integer literal without suffix.
pub(super) fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// A multiple of pi as an expression: `pi / 2` instead of 1.5707….
pub(super) fn turn(count: i32, parts: u32) -> TokenStream {
    let (n, d) = (float(count), float(parts));
    match (count == 1, parts == 1) {
        (true, true) => quote!(T::pi()),
        (true, false) => quote!(T::pi() / __rt::real::<T>(#d)),
        (false, true) => quote!(T::pi() * __rt::real::<T>(#n)),
        (false, false) => quote!(T::pi() * __rt::real::<T>(#n) / __rt::real::<T>(#d)),
    }
}

/// An integer as the literal of a float.
fn float(value: impl Into<f64>) -> Literal {
    Literal::f64_unsuffixed(value.into())
}

/// A constant as an `f64`.
pub(super) fn plain(number: Number) -> TokenStream {
    let magnitude = number.absolute();
    let tokens = match parts_of_pi(magnitude) {
        Some((count, parts)) => {
            let (n, d) = (float(count), float(parts));
            quote!(::core::f64::consts::PI * #n / #d)
        }
        None => separated(magnitude.to_f64()),
    };
    if number.is_negative() { quote!(-#tokens) } else { tokens }
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
pub(super) fn is_long(number: Number) -> bool {
    matches!(number, Number::Ratio(_, d) if d != 1 && number.as_quotient().is_none())
}

/// A constant as a number of any kind: a ratio exactly.
pub(super) fn exact(number: Number) -> TokenStream {
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
    groups.join("_").parse().unwrap_or_default()
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
