//! The notation of the `linkage!` language.

use crate::graph::{Function, Number};

use super::Name;
use super::style::{Binding, Style};

pub(super) struct Language;

impl Style for Language {
    fn has_bars(&self) -> bool {
        false
    }

    fn number(&self, value: Number) -> String {
        value.to_string()
    }

    fn pi(&self) -> &'static str {
        "pi"
    }

    fn ellipsis(&self) -> &'static str {
        "…"
    }

    fn name(&self, name: Name) -> (String, Binding) {
        (name.subject().to_owned(), Binding::Atom)
    }

    fn brackets(&self, body: &str) -> String {
        format!("({body})")
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        join(terms, '-')
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join("*")
    }

    fn quotient(&self, above: &str, below: &[String]) -> String {
        // A number divides first: 3*a/2/b.
        let (number, rest) = match below {
            [first, rest @ ..] if first.starts_with(|c: char| c.is_ascii_digit()) => (Some(first), rest),
            _ => (None, below),
        };
        let above = number.map_or_else(|| above.to_owned(), |number| format!("{above}/{number}"));
        match rest {
            [] => above,
            [one] => format!("{above}/{one}"),
            many => format!("{above}/({})", many.join("*")),
        }
    }

    fn power(&self, base: &str, exponent: u32) -> String {
        format!("{base}^{exponent}")
    }

    fn call(&self, function: Function, arguments: &[String], exponent: u32, _bare: bool) -> String {
        let call = format!("{}({})", function.operation().name, arguments.join(", "));
        if exponent == 1 { call } else { self.power(&call, exponent) }
    }

    fn external(&self, names: &[String], order: usize, arguments: &[String]) -> String {
        format!("{}({})", names.get(order).map_or("…", String::as_str), arguments.join(", "))
    }
}

/// Terms joined by their signs, with a space about each but the first.
pub(super) fn join(terms: &[(bool, String)], minus: char) -> String {
    let mut text = String::new();
    for (negative, body) in terms {
        let sign = if *negative { minus } else { '+' };
        match (text.is_empty(), negative) {
            (true, false) => {}
            (true, true) => text.push(sign),
            (false, _) => text.extend([' ', sign, ' ']),
        }
        text.push_str(body);
    }
    text
}
