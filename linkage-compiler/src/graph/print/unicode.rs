//! One line of plain text.

use crate::graph::{Function, Number};

use super::Name;
use super::language::join;
use super::style::{Binding, Style, digits, function_name, is_circular};

pub(super) struct Unicode;

impl Style for Unicode {
    fn has_bars(&self) -> bool {
        false
    }

    fn number(&self, value: Number) -> String {
        match digits(value) {
            (digits, None) => digits,
            (digits, Some(exponent)) => format!("{digits}·10{}", shifted(&exponent, Shift::Up)),
        }
    }

    fn pi(&self) -> &'static str {
        "π"
    }

    fn ellipsis(&self) -> &'static str {
        "…"
    }

    fn name(&self, name: Name) -> (String, Binding) {
        let binding = match name {
            Name::Ratio { .. } => Binding::Slash,
            Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        };
        (name.unicode(), binding)
    }

    fn brackets(&self, body: &str) -> String {
        format!("({body})")
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        join(terms, '−')
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join("·")
    }

    fn quotient(&self, above: &str, below: &[String]) -> String {
        match below {
            [one] => format!("{above}/{one}"),
            many => format!("{above}/({})", many.join("·")),
        }
    }

    fn power(&self, base: &str, exponent: u32) -> String {
        format!("{base}{}", shifted(&exponent.to_string(), Shift::Up))
    }

    fn call(&self, function: Function, arguments: &[String], exponent: u32, _bare: bool) -> String {
        let arguments = arguments.join(", ");
        let name = function_name(function);
        match (function, exponent) {
            (Function::Sqrt, _) => format!("√({arguments})"),
            (Function::Abs, _) => format!("|{arguments}|"),
            (_, 2..) if is_circular(function) => format!("{}({arguments})", self.power(name, exponent)),
            _ => format!("{name}({arguments})"),
        }
    }
}

#[derive(Clone, Copy)]
pub(super) enum Shift {
    Up,
    Down,
}

/// Digits and a minus sign above or below the line.
pub(super) fn shifted(digits: &str, shift: Shift) -> String {
    let (ten, minus): (&[char], char) = match shift {
        Shift::Up => (&['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'], '⁻'),
        Shift::Down => (&['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'], '₋'),
    };
    let place = |c: char| match c.to_digit(10) {
        Some(digit) => ten[digit as usize],
        None => minus,
    };
    digits.chars().map(place).collect()
}
