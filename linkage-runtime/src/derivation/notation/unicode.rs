//! One line of plain text.

use core::fmt::{self, Write};

use super::name::{Name, Word, greek, is_number, primes};
use super::{Argument, Binding, Marks, Style, function_name, is_circular};

pub(super) struct Unicode;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " − ",
    leading_minus: "−",
    times: "·",
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

    fn number(&self, out: &mut dyn Write, digits: &str, exponent: Option<&str>) -> fmt::Result {
        out.write_str(digits)?;
        exponent.map_or(Ok(()), |exponent| {
            out.write_str("·10")?;
            self.exponent(out, exponent)
        })
    }

    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result {
        match name {
            Name::Plain(name) => word(out, name, None),
            Name::Rate(name) => word(out, name, Some('\u{307}')),
            Name::Acceleration(name) => word(out, name, Some('\u{308}')),
            Name::Ratio { of, by } => {
                out.write_str("∂")?;
                word(out, of, None)?;
                out.write_str("/∂")?;
                word(out, by, None)
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.write_str("∂²")?;
                word(out, of, None)?;
                out.write_str("/∂")?;
                word(out, first, None)?;
                if first == second {
                    return out.write_str("²");
                }
                out.write_str("∂")?;
                word(out, second, None)
            }
            Name::Determinant(matrix) => {
                out.write_str("det ")?;
                word(out, matrix, None)
            }
            Name::Inverse(matrix) => {
                word(out, matrix, None)?;
                out.write_str("⁻¹")
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

    fn exponent(&self, out: &mut dyn Write, exponent: &str) -> fmt::Result {
        shifted(out, exponent, Shift::Up)
    }

    fn function(&self, out: &mut dyn Write, name: &str, exponent: &str, _argument: Argument) -> fmt::Result {
        out.write_str(function_name(name))?;
        if exponent != "1" && is_circular(name) {
            self.exponent(out, exponent)?;
        }
        out.write_str("(")
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: usize, _tall: bool) -> fmt::Result {
        word(out, name, None)?;
        match primes(order) {
            Some(primes) => out.write_str(primes)?,
            None => {
                out.write_str("⁽")?;
                raised(out, order)?;
                out.write_str("⁾")?;
            }
        }
        out.write_str("(")
    }

    fn end_of_function(&self, _argument: Argument) -> &'static str {
        ")"
    }
}

/// A number above the line.
fn raised(out: &mut dyn Write, number: usize) -> fmt::Result {
    if number > 9 {
        raised(out, number / 10)?;
    }
    let digit = char::from_digit((number % 10) as u32, 10).unwrap_or('0');
    shifted(out, digit.encode_utf8(&mut [0; 4]), Shift::Up)
}

/// A word, dots above the last letter of its base.
fn word(out: &mut dyn Write, name: &str, dots: Option<char>) -> fmt::Result {
    let name = Word::new(name);
    let mut letter = [0; 4];
    let base = greek(name.base).map_or(name.base, |(_, sign)| sign.encode_utf8(&mut letter));
    match dots {
        Some(dots) => dotted(out, base, dots)?,
        None => out.write_str(base)?,
    }
    for (index, subscript) in name.subscripts().enumerate() {
        // Few letters have a form below the line: words stand behind an underscore.
        if index == 0 && is_number(subscript) {
            shifted(out, subscript, Shift::Down)?;
        } else {
            out.write_str("_")?;
            match greek(subscript) {
                Some((_, letter)) => out.write_char(letter)?,
                None => out.write_str(subscript)?,
            }
        }
    }
    Ok(())
}

#[derive(Clone, Copy)]
enum Shift {
    Up,
    Down,
}

/// Digits and a minus sign above or below the line.
fn shifted(out: &mut dyn Write, digits: &str, shift: Shift) -> fmt::Result {
    let (ten, minus): (&[char], char) = match shift {
        Shift::Up => (&['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'], '⁻'),
        Shift::Down => (&['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'], '₋'),
    };
    for digit in digits.chars() {
        out.write_char(digit.to_digit(10).map_or(minus, |digit| ten[digit as usize]))?;
    }
    Ok(())
}

/// The letters that have a form of their own with a dot above, and with two, in the order of those
/// forms: text in normal form C (Unicode Standard Annex 15) writes these as one character.
const DOTTED: [(char, &str, &str); 2] = [
    ('\u{307}', "ABCDEFGHIMNOPRSTWXYZabcdefghmnoprstwxyz", "ȦḂĊḊĖḞĠḢİṀṄȮṖṘṠṪẆẊẎŻȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż"),
    ('\u{308}', "AEHIOUWXYaehiotuwxyΙΥιυ", "ÄËḦÏÖÜẄẌŸäëḧïöẗüẅẍÿΪΫϊϋ"),
];

/// A word with dots above its last letter.
fn dotted(out: &mut dyn Write, word: &str, dots: char) -> fmt::Result {
    let Some(last) = word.chars().next_back() else { return Ok(()) };
    let table = DOTTED.iter().find(|(accent, ..)| *accent == dots);
    let whole = table.and_then(|(_, plain, dotted)| {
        plain.chars().zip(dotted.chars()).find(|(plain, _)| *plain == last).map(|(_, dotted)| dotted)
    });
    match whole {
        Some(whole) => {
            out.write_str(&word[..word.len() - last.len_utf8()])?;
            out.write_char(whole)
        }
        None => {
            out.write_str(word)?;
            out.write_char(dots)
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
            dotted(&mut text, word, dots).map(|()| text)
        });
        assert_eq!(found, ["ẋ", "crank\u{307}", "anglë", "θ\u{307}", "φ\u{308}", ""].map(|text| Ok(text.to_owned())));
        for (accent, plain, dotted) in DOTTED {
            assert_eq!(plain.chars().count(), dotted.chars().count(), "{accent}");
        }
    }
}
