//! One line of plain text.

use crate::graph::{Function, Number};

use super::Name;
use super::language::join;
use super::style::{Binding, Style, digits, function_name, is_circular, primes};

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
            Name::Ratio { .. } | Name::RatioDerivative { .. } => Binding::Slash,
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

    fn external(&self, names: &[String], order: usize, arguments: &[String]) -> String {
        let name = names.first().map(|name| Name::Plain(name).unicode()).unwrap_or_default();
        let order =
            primes(order).map_or_else(|| format!("⁽{}⁾", shifted(&order.to_string(), Shift::Up)), str::to_owned);
        format!("{name}{order}({})", arguments.join(", "))
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

/// The letters that have a form of their own with a dot above, and with two, in the order of those
/// forms: text in normal form C (Unicode Standard Annex 15) writes these as one character.
const DOTTED: [(char, &str, &str); 2] = [
    ('\u{307}', "ABCDEFGHIMNOPRSTWXYZabcdefghmnoprstwxyz", "ȦḂĊḊĖḞĠḢİṀṄȮṖṘṠṪẆẊẎŻȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż"),
    ('\u{308}', "AEHIOUWXYaehiotuwxyΙΥιυ", "ÄËḦÏÖÜẄẌŸäëḧïöẗüẅẍÿΪΫϊϋ"),
];

/// A word with dots, if any, above its last letter.
pub(super) fn dotted(word: &str, dots: &str) -> String {
    let (Some(last), Some(dot)) = (word.chars().next_back(), dots.chars().next()) else { return word.to_owned() };
    let table = DOTTED.iter().find(|(accent, ..)| *accent == dot);
    let whole = table.and_then(|(_, plain, dotted)| {
        plain.chars().zip(dotted.chars()).find(|(plain, _)| *plain == last).map(|(_, dotted)| dotted)
    });
    match whole {
        Some(whole) => word[..word.len() - last.len_utf8()].to_owned() + whole.encode_utf8(&mut [0; 4]),
        None => format!("{word}{dots}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_stand_on_the_last_letter_in_normal_form() {
        let found = [
            ("x", "\u{307}"),
            ("crank", "\u{307}"),
            ("angle", "\u{308}"),
            ("θ", "\u{307}"),
            ("φ", "\u{308}"),
            ("x", ""),
        ]
        .map(|(word, dots)| dotted(word, dots));
        assert_eq!(found, ["ẋ", "crank\u{307}", "anglë", "θ\u{307}", "φ\u{308}", "x"]);
        for (accent, plain, dotted) in DOTTED {
            assert_eq!(plain.chars().count(), dotted.chars().count(), "{accent}");
        }
    }
}
