//! Formulas as one line of plain text.

use core::fmt::{self, Write};

use super::super::ElementaryFunction;
use super::name::{Name, Word, greek, is_number, numbered_greek, primes};
use super::style::{Argument, Binding, Marks, Style, is_circular};

/// One line of Unicode.
pub struct Unicode;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " − ",
    leading_minus: "−",
    times: "·",
    times_word: "·",
    times_function: "·",
    comma: ", ",
    at_most: " ≤ ",
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
        match exponent {
            Some(exponent) => write!(out, "·10{}", Shifted(exponent, Shift::Up)),
            None => Ok(()),
        }
    }

    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result {
        match name {
            Name::Plain(name) => write!(out, "{}", Dotted(name, None)),
            Name::Rate(name) => write!(out, "{}", Dotted(name, Some('\u{307}'))),
            Name::Acceleration(name) => write!(out, "{}", Dotted(name, Some('\u{308}'))),
            Name::Ratio { of, by } => write!(out, "∂{}/∂{}", plain(of), plain(by)),
            Name::RatioDerivative { of, by: [first, second] } if first == second => {
                write!(out, "∂²{}/∂{}²", plain(of), plain(first))
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                write!(out, "∂²{}/∂{}∂{}", plain(of), plain(first), plain(second))
            }
            Name::Determinant(matrix) => write!(out, "det {}", plain(matrix)),
            Name::Inverse(matrix) => write!(out, "{}⁻¹", plain(matrix)),
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } => Binding::Slash,
            Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut dyn Write, exponent: u32) -> fmt::Result {
        write!(Raised(out), "{exponent}")
    }

    fn function(
        &self,
        out: &mut dyn Write,
        function: ElementaryFunction,
        exponent: u32,
        _argument: Argument,
    ) -> fmt::Result {
        out.write_str(function.in_mathematics())?;
        if exponent != 1 && is_circular(function) {
            self.exponent(out, exponent)?;
        }
        out.write_char('(')
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: u32, _tall: bool) -> fmt::Result {
        write!(out, "{}", plain(name))?;
        match primes(order) {
            Some(primes) => out.write_str(primes)?,
            None => {
                out.write_char('⁽')?;
                self.exponent(out, order)?;
                out.write_char('⁾')?;
            }
        }
        out.write_char('(')
    }

    fn end_of_function(&self, _argument: Argument) -> &'static str {
        ")"
    }
}

/// A name without dots.
fn plain(name: &str) -> Dotted<'_> {
    Dotted(name, None)
}

/// A name, with dots above the last letter of its base.
struct Dotted<'a>(&'a str, Option<char>);

impl fmt::Display for Dotted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(name, dots) = *self;
        let name = Word::new(name);
        let mut letter = [0; 4];
        let base = greek(name.base).map_or(name.base, |(_, sign)| sign.encode_utf8(&mut letter));
        match dots {
            Some(dots) => dotted(f, base, dots)?,
            None => f.write_str(base)?,
        }
        for (index, subscript) in name.subscripts().enumerate() {
            // Few letters have a subscript form: other subscripts follow an underscore.
            if index == 0 && is_number(subscript) {
                write!(f, "{}", Shifted(subscript, Shift::Down))?;
            } else {
                f.write_char('_')?;
                let (letter, number) = numbered_greek(subscript).unwrap_or((subscript, ""));
                match greek(letter) {
                    Some((_, letter)) => f.write_char(letter)?,
                    None => f.write_str(subscript)?,
                }
                write!(f, "{}", Shifted(number, Shift::Down))?;
            }
        }
        Ok(())
    }
}

/// Writes digits as superscripts.
struct Raised<'a>(&'a mut dyn Write);

impl Write for Raised<'_> {
    fn write_str(&mut self, digits: &str) -> fmt::Result {
        write!(self.0, "{}", Shifted(digits, Shift::Up))
    }
}

#[derive(Clone, Copy)]
enum Shift {
    Up,
    Down,
}

/// Digits and minus signs as superscripts or subscripts.
struct Shifted<'a>(&'a str, Shift);

impl fmt::Display for Shifted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (ten, minus): (&[char], char) = match self.1 {
            Shift::Up => (&['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'], '⁻'),
            Shift::Down => (&['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'], '₋'),
        };
        for digit in self.0.chars() {
            f.write_char(digit.to_digit(10).map_or(minus, |digit| ten[digit as usize]))?;
        }
        Ok(())
    }
}

/// The letters with precomposed forms with one dot and with two dots above, and these forms, as in normal form C
/// (Unicode Standard Annex 15).
const DOTTED: [(char, &str, &str); 2] = [
    ('\u{307}', "ABCDEFGHIMNOPRSTWXYZabcdefghmnoprstwxyz", "ȦḂĊḊĖḞĠḢİṀṄȮṖṘṠṪẆẊẎŻȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż"),
    ('\u{308}', "AEHIOUWXYaehiotuwxyΙΥιυ", "ÄËḦÏÖÜẄẌŸäëḧïöẗüẅẍÿΪΫϊϋ"),
];

/// Writes a word with dots above its last letter.
fn dotted(out: &mut dyn Write, word: &str, dots: char) -> fmt::Result {
    let Some(last) = word.chars().next_back() else { return Ok(()) };
    let table = DOTTED.iter().find(|(accent, ..)| *accent == dots);
    let whole = table.and_then(|(_, plain, dotted)| {
        plain.chars().zip(dotted.chars()).find(|(plain, _)| *plain == last).map(|(_, dotted)| dotted)
    });
    match whole {
        Some(whole) => write!(out, "{}{whole}", &word[..word.len() - last.len_utf8()]),
        None => write!(out, "{word}{dots}"),
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
            let mut text = std::string::String::new();
            dotted(&mut text, word, dots).unwrap();
            text
        });
        assert_eq!(found, ["ẋ", "crank\u{307}", "anglë", "θ\u{307}", "φ\u{308}", ""]);
        for (accent, plain, dotted) in DOTTED {
            assert_eq!(plain.chars().count(), dotted.chars().count(), "{accent}");
        }
    }
}
