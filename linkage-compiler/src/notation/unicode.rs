//! Formulas as one line of plain text.

use super::formula::Formula;
use super::name::{Name, Word, greek, is_number, matrix_name, numbered_greek, primes};
use super::style::{Argument, Binding, Marks, Style, function_name, is_circular};
use crate::graph::Function;

pub(super) struct Unicode;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " − ",
    leading_minus: "−",
    times: "·",
    times_word: "·",
    times_function: "·",
    comma: ", ",
    not_zero: " ≠ 0",
    exists: " exists",
    pi: "π",
    ellipsis: "…",
    sum: ["", ""],
    product: ["", ""],
    brackets: ["(", ")"],
    tall_brackets: ["(", ")"],
    modulus: ["|", "|"],
    root: ["√(", ")"],
    fraction: ["", "/", ""],
    fraction_of_many: ["", "/(", ")"],
    has_bars: false,
    power: "",
};

impl Style for Unicode {
    fn marks(&self) -> &'static Marks {
        &MARKS
    }

    fn of<'f>(&self, formula: &'f Formula) -> &'f str {
        &formula.text
    }

    fn number(&self, out: &mut String, digits: &str, exponent: Option<&str>) {
        out.push_str(digits);
        if let Some(exponent) = exponent {
            out.push_str("·10");
            shifted(out, exponent, Shift::Up);
        }
    }

    fn name(&self, out: &mut String, name: Name<'_>) {
        match name {
            Name::Plain(name) => word(out, name, None),
            Name::Rate(name) => word(out, name, Some('\u{307}')),
            Name::Acceleration(name) => word(out, name, Some('\u{308}')),
            Name::Ratio { of, by } => {
                out.push('∂');
                word(out, of, None);
                out.push_str("/∂");
                word(out, by, None);
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.push_str("∂²");
                word(out, of, None);
                out.push_str("/∂");
                word(out, first, None);
                if first == second {
                    return out.push('²');
                }
                out.push('∂');
                word(out, second, None);
            }
            Name::Determinant(block) => {
                out.push_str("det ");
                word(out, &matrix_name(block), None);
            }
            Name::Inverse(block) => {
                word(out, &matrix_name(block), None);
                out.push_str("⁻¹");
            }
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } => Binding::Slash,
            Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut String, exponent: u32) {
        shifted(out, &exponent.to_string(), Shift::Up);
    }

    fn function(&self, out: &mut String, function: Function, exponent: u32, _argument: Argument) {
        out.push_str(function_name(function));
        if exponent != 1 && is_circular(function) {
            self.exponent(out, exponent);
        }
        out.push('(');
    }

    fn external(&self, out: &mut String, name: &str, order: usize, _tall: bool) {
        word(out, name, None);
        match primes(order) {
            Some(primes) => out.push_str(primes),
            None => {
                out.push('⁽');
                shifted(out, &order.to_string(), Shift::Up);
                out.push('⁾');
            }
        }
        out.push('(');
    }

    fn end_of_function(&self, _argument: Argument) -> &'static str {
        ")"
    }
}

/// Writes a name, with dots above the last letter of its base.
fn word(out: &mut String, name: &str, dots: Option<char>) {
    let name = Word::new(name);
    let mut letter = [0; 4];
    let base = greek(name.base).map_or(name.base, |(_, sign)| sign.encode_utf8(&mut letter));
    match dots {
        Some(dots) => dotted(out, base, dots),
        None => out.push_str(base),
    }
    for (index, subscript) in name.subscripts().enumerate() {
        // Few letters have a subscript form: other subscripts follow an underscore.
        if index == 0 && is_number(subscript) {
            shifted(out, subscript, Shift::Down);
        } else {
            out.push('_');
            let (letter, number) = numbered_greek(subscript).unwrap_or((subscript, ""));
            match greek(letter) {
                Some((_, letter)) => out.push(letter),
                None => out.push_str(subscript),
            }
            shifted(out, number, Shift::Down);
        }
    }
}

#[derive(Clone, Copy)]
enum Shift {
    Up,
    Down,
}

/// Writes digits and minus signs as superscripts or subscripts.
fn shifted(out: &mut String, digits: &str, shift: Shift) {
    let (ten, minus): (&[char], char) = match shift {
        Shift::Up => (&['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'], '⁻'),
        Shift::Down => (&['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'], '₋'),
    };
    for digit in digits.chars() {
        out.push(digit.to_digit(10).map_or(minus, |digit| ten[digit as usize]));
    }
}

/// The letters with precomposed forms with one dot and with two dots above, and these forms, as in normal form C
/// (Unicode Standard Annex 15).
const DOTTED: [(char, &str, &str); 2] = [
    ('\u{307}', "ABCDEFGHIMNOPRSTWXYZabcdefghmnoprstwxyz", "ȦḂĊḊĖḞĠḢİṀṄȮṖṘṠṪẆẊẎŻȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż"),
    ('\u{308}', "AEHIOUWXYaehiotuwxyΙΥιυ", "ÄËḦÏÖÜẄẌŸäëḧïöẗüẅẍÿΪΫϊϋ"),
];

/// Writes a word with dots above its last letter.
fn dotted(out: &mut String, word: &str, dots: char) {
    let Some(last) = word.chars().next_back() else { return };
    let table = DOTTED.iter().find(|(accent, ..)| *accent == dots);
    let whole = table.and_then(|(_, plain, dotted)| {
        plain.chars().zip(dotted.chars()).find(|(plain, _)| *plain == last).map(|(_, dotted)| dotted)
    });
    match whole {
        Some(whole) => {
            out.push_str(&word[..word.len() - last.len_utf8()]);
            out.push(whole);
        }
        None => {
            out.push_str(word);
            out.push(dots);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_stand_on_the_last_letter_in_normal_form() {
        let found = [
            ("x", '\u{307}'),
            ("crank", '\u{307}'),
            ("angle", '\u{308}'),
            ("θ", '\u{307}'),
            ("φ", '\u{308}'),
            ("", '\u{307}'),
        ]
        .map(|(word, dots)| {
            let mut text = String::new();
            dotted(&mut text, word, dots);
            text
        });
        assert_eq!(found, ["ẋ", "crank\u{307}", "anglë", "θ\u{307}", "φ\u{308}", ""]);
        for (accent, plain, dotted) in DOTTED {
            assert_eq!(plain.chars().count(), dotted.chars().count(), "{accent}");
        }
    }
}
