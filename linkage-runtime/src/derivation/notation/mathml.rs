//! Presentation MathML, of the Core subset. Every formula is one element.

use core::fmt::{self, Write};

use super::name::{Name, Word, greek, is_number, primes};
use super::{Argument, Binding, Marks, Style, function_name, is_circular};

/// U+2061.
const FUNCTION_APPLICATION: &str = "<mo>\u{2061}</mo>";
/// The same before an argument without brackets.
const SPACED_APPLICATION: &str = "<mo rspace=\"0.17em\">\u{2061}</mo>";

pub(super) struct MathMl;

const MARKS: Marks = Marks {
    plus: "<mo>+</mo>",
    minus: "<mo>−</mo>",
    leading_minus: "<mo>−</mo>",
    // U+2062, which separates factors for readers that speak; the name of a function needs room.
    times: "<mo>\u{2062}</mo>",
    times_function: "<mo rspace=\"0.17em\">\u{2062}</mo>",
    comma: "<mo>,</mo>",
    not_zero: "<mo>≠</mo><mn>0</mn>",
    exists: "<mtext> exists</mtext>",
    pi: "<mi>π</mi>",
    ellipsis: "<mi>…</mi>",
    sum: ["<mrow>", "</mrow>"],
    product: ["<mrow>", "</mrow>"],
    brackets: ["<mrow><mo>(</mo>", "<mo>)</mo></mrow>"],
    tall_brackets: ["<mrow><mo>(</mo>", "<mo>)</mo></mrow>"],
    modulus: ["<mrow><mo>|</mo>", "<mo>|</mo></mrow>"],
    root: ["<msqrt>", "</msqrt>"],
    fraction: ["<mfrac>", "", "</mfrac>"],
    fraction_of_many: ["<mfrac>", "", "</mfrac>"],
    has_bars: true,
    power: "<msup>",
};

impl Style for MathMl {
    fn marks(&self) -> &'static Marks {
        &MARKS
    }

    fn number(&self, out: &mut dyn Write, digits: &str, exponent: Option<&str>) -> fmt::Result {
        let Some(exponent) = exponent else { return write!(out, "<mn>{digits}</mn>") };
        write!(out, "<mrow><mn>{digits}</mn><mo>⋅</mo><msup><mn>10</mn>")?;
        match exponent.strip_prefix('-') {
            Some(positive) => write!(out, "<mrow><mo>−</mo><mn>{positive}</mn></mrow>")?,
            None => write!(out, "<mn>{exponent}</mn>")?,
        }
        out.write_str("</msup></mrow>")
    }

    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result {
        let side = |out: &mut dyn Write, name: &str| {
            out.write_str("<mrow><mo>∂</mo>")?;
            word(out, name, Shape::PLAIN)?;
            out.write_str("</mrow>")
        };
        match name {
            Name::Plain(name) => word(out, name, Shape::PLAIN),
            Name::Rate(name) => word(out, name, Shape { dots: "˙", ..Shape::PLAIN }),
            Name::Acceleration(name) => word(out, name, Shape { dots: "¨", ..Shape::PLAIN }),
            Name::Ratio { of, by } => {
                out.write_str("<mfrac>")?;
                side(out, of)?;
                side(out, by)?;
                out.write_str("</mfrac>")
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.write_str("<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup>")?;
                word(out, of, Shape::PLAIN)?;
                out.write_str("</mrow><mrow><mo>∂</mo>")?;
                if first == second {
                    out.write_str("<msup><mrow>")?;
                    word(out, first, Shape::PLAIN)?;
                    out.write_str("</mrow><mn>2</mn></msup>")?;
                } else {
                    word(out, first, Shape::PLAIN)?;
                    out.write_str("<mo>∂</mo>")?;
                    word(out, second, Shape::PLAIN)?;
                }
                out.write_str("</mrow></mfrac>")
            }
            Name::Determinant(matrix) => {
                out.write_str("<mrow><mi>det</mi><mo rspace=\"0.17em\">\u{2061}</mo>")?;
                word(out, matrix, Shape::PLAIN)?;
                out.write_str("</mrow>")
            }
            Name::Inverse(matrix) => {
                out.write_str("<msup>")?;
                word(out, matrix, Shape::PLAIN)?;
                out.write_str("<mrow><mo>−</mo><mn>1</mn></mrow></msup>")
            }
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut dyn Write, exponent: &str) -> fmt::Result {
        write!(out, "<mn>{exponent}</mn></msup>")
    }

    fn function(&self, out: &mut dyn Write, name: &str, exponent: &str, argument: Argument) -> fmt::Result {
        out.write_str("<mrow>")?;
        let shown = function_name(name);
        if exponent != "1" && is_circular(name) {
            write!(out, "<msup><mi>{shown}</mi><mn>{exponent}</mn></msup>")?;
        } else {
            write!(out, "<mi>{shown}</mi>")?;
        }
        if argument == Argument::Bare {
            return out.write_str(SPACED_APPLICATION);
        }
        out.write_str(FUNCTION_APPLICATION)?;
        out.write_str(MARKS.brackets[0])
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: usize, _tall: bool) -> fmt::Result {
        let above = match (order, primes(order)) {
            (0, _) => Above::Nothing,
            (_, Some(primes)) => Above::Primes(primes),
            (_, None) => Above::Order(order),
        };
        out.write_str("<mrow>")?;
        word(out, name, Shape { dots: "", above })?;
        out.write_str(FUNCTION_APPLICATION)?;
        out.write_str(MARKS.brackets[0])
    }

    fn end_of_function(&self, argument: Argument) -> &'static str {
        if argument == Argument::Bare { "</mrow>" } else { "<mo>)</mo></mrow></mrow>" }
    }

    fn power(&self, out: &mut dyn Write, name: Name<'_>, exponent: &str) -> fmt::Result {
        let (name, dots) = match name {
            Name::Plain(name) => (name, ""),
            Name::Rate(name) => (name, "˙"),
            Name::Acceleration(name) => (name, "¨"),
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) | Name::Inverse(_) => {
                out.write_str(MARKS.power)?;
                self.name(out, name)?;
                return self.exponent(out, exponent);
            }
        };
        word(out, name, Shape { dots, above: Above::Power(exponent) })
    }
}

/// What stands above a word.
#[derive(Clone, Copy)]
struct Shape<'a> {
    dots: &'a str,
    above: Above<'a>,
}

#[derive(Clone, Copy)]
enum Above<'a> {
    Nothing,
    Power(&'a str),
    Primes(&'a str),
    Order(usize),
}

impl Shape<'_> {
    const PLAIN: Self = Self { dots: "", above: Above::Nothing };
}

/// A word; an index and an exponent stand above each other.
fn word(out: &mut dyn Write, name: &str, Shape { dots, above }: Shape<'_>) -> fmt::Result {
    let name = Word::new(name);
    let mut subscripts = name.subscripts();
    let bare = matches!(above, Above::Nothing);
    let element = match (subscripts.next(), bare) {
        (None, true) => "",
        (None, false) => "msup",
        (Some(_), true) => "msub",
        (Some(_), false) => "msubsup",
    };
    if !element.is_empty() {
        write!(out, "<{element}>")?;
    }
    // Dots above a letter do not lift its exponent.
    let lowered = !dots.is_empty() && !bare;
    if lowered {
        out.write_str("<mpadded height=\"0.75em\">")?;
    }
    if dots.is_empty() {
        part(out, name.base)?;
    } else {
        out.write_str("<mover>")?;
        part(out, name.base)?;
        write!(out, "<mo>{dots}</mo></mover>")?;
    }
    if lowered {
        out.write_str("</mpadded>")?;
    }
    let several = subscripts.next().is_some();
    if several {
        out.write_str("<mrow>")?;
    }
    for (index, subscript) in name.subscripts().enumerate() {
        if index > 0 {
            out.write_str(MARKS.comma)?;
        }
        part(out, subscript)?;
    }
    if several {
        out.write_str("</mrow>")?;
    }
    match above {
        Above::Nothing => {}
        Above::Power(exponent) => write!(out, "<mn>{exponent}</mn>")?,
        Above::Primes(primes) => write!(out, "<mo>{primes}</mo>")?,
        Above::Order(order) => write!(out, "<mrow><mo>(</mo><mn>{order}</mn><mo>)</mo></mrow>")?,
    }
    if element.is_empty() { Ok(()) } else { write!(out, "</{element}>") }
}

fn part(out: &mut dyn Write, word: &str) -> fmt::Result {
    if let Some((_, letter)) = greek(word) {
        return write!(out, "<mi>{letter}</mi>");
    }
    if is_number(word) {
        return write!(out, "<mn>{word}</mn>");
    }
    out.write_str("<mi>")?;
    for letter in word.chars() {
        match letter {
            '&' => out.write_str("&amp;")?,
            '<' => out.write_str("&lt;")?,
            '>' => out.write_str("&gt;")?,
            letter => out.write_char(letter)?,
        }
    }
    out.write_str("</mi>")
}
