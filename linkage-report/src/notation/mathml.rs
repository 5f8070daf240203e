//! Presentation MathML, in the subset MathML Core. Every formula is one element.

use std::fmt::{self, Write};

use linkage_runtime::derivation::ElementaryFunction;
use linkage_runtime::derivation::notation::{
    Argument, Binding, Marks, Name, Style, Word, greek, is_circular, is_number, numbered_greek, primes,
};

/// U+2061.
const FUNCTION_APPLICATION: &str = "<mo>\u{2061}</mo>";
/// U+2061 with space after it, before an argument without brackets.
const SPACED_APPLICATION: &str = "<mo rspace=\"0.17em\">\u{2061}</mo>";

pub(super) struct MathMl;

const MARKS: Marks = Marks {
    plus: "<mo>+</mo>",
    minus: "<mo>−</mo>",
    leading_minus: "<mo>−</mo>",
    // U+2062, invisible times, for screen readers; with space before the name of a function.
    times: "<mo>\u{2062}</mo>",
    times_word: "<mo>⋅</mo>",
    times_function: "<mo rspace=\"0.17em\">\u{2062}</mo>",
    comma: "<mo>,</mo>",
    at_most: "<mo>≤</mo>",
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
        match name {
            Name::Plain(name) => write!(out, "{}", plain(name)),
            Name::Rate(name) => write!(out, "{}", Marked { dots: "˙", ..plain(name) }),
            Name::Acceleration(name) => write!(out, "{}", Marked { dots: "¨", ..plain(name) }),
            Name::Ratio { of, by } => {
                let [of, by] = [of, by].map(plain);
                write!(out, "<mfrac><mrow><mo>∂</mo>{of}</mrow><mrow><mo>∂</mo>{by}</mrow></mfrac>")
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                write!(out, "<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup>{}</mrow><mrow><mo>∂</mo>", plain(of))?;
                if first == second {
                    write!(out, "<msup><mrow>{}</mrow><mn>2</mn></msup>", plain(first))?;
                } else {
                    write!(out, "{}<mo>∂</mo>{}", plain(first), plain(second))?;
                }
                out.write_str("</mrow></mfrac>")
            }
            Name::Determinant(matrix) => {
                let matrix = plain(matrix);
                write!(out, "<mrow><mi>det</mi>{SPACED_APPLICATION}{matrix}</mrow>")
            }
            Name::Inverse(matrix) => {
                write!(out, "<msup>{}<mrow><mo>−</mo><mn>1</mn></mrow></msup>", plain(matrix))
            }
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut dyn Write, exponent: u32) -> fmt::Result {
        write!(out, "<mn>{exponent}</mn></msup>")
    }

    fn function(
        &self,
        out: &mut dyn Write,
        function: ElementaryFunction,
        exponent: u32,
        argument: Argument,
    ) -> fmt::Result {
        let shown = function.in_mathematics();
        if exponent != 1 && is_circular(function) {
            write!(out, "<mrow><msup><mi>{shown}</mi><mn>{exponent}</mn></msup>")?;
        } else {
            write!(out, "<mrow><mi>{shown}</mi>")?;
        }
        if argument == Argument::Bare {
            return out.write_str(SPACED_APPLICATION);
        }
        write!(out, "{FUNCTION_APPLICATION}{}", MARKS.brackets[0])
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: u32, _tall: bool) -> fmt::Result {
        let above = match (order, primes(order)) {
            (0, _) => Above::Nothing,
            (_, Some(primes)) => Above::Primes(primes),
            (_, None) => Above::Order(order),
        };
        write!(out, "<mrow>{}{FUNCTION_APPLICATION}{}", Marked { above, ..plain(name) }, MARKS.brackets[0])
    }

    fn end_of_function(&self, argument: Argument) -> &'static str {
        if argument == Argument::Bare { "</mrow>" } else { "<mo>)</mo></mrow></mrow>" }
    }

    fn power(&self, out: &mut dyn Write, name: Name<'_>, exponent: u32) -> fmt::Result {
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
        write!(out, "{}", Marked { name, dots, above: Above::Power(exponent) })
    }
}

/// A name without marks.
fn plain(name: &str) -> Marked<'_> {
    Marked { name, dots: "", above: Above::Nothing }
}

/// A name with marks above; subscript and exponent are aligned.
struct Marked<'a> {
    name: &'a str,
    dots: &'static str,
    above: Above,
}

#[derive(Clone, Copy)]
enum Above {
    Nothing,
    Power(u32),
    Primes(&'static str),
    Order(u32),
}

impl fmt::Display for Marked<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, dots, above } = *self;
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
            write!(f, "<{element}>")?;
        }
        // The exponent must not be raised by the dots above the letter.
        let lowered = !dots.is_empty() && !bare;
        let [open, close] = if lowered { ["<mpadded height=\"0.75em\">", "</mpadded>"] } else { ["", ""] };
        let base = Part(name.base);
        if dots.is_empty() {
            write!(f, "{base}")?
        } else {
            write!(f, "{open}<mover>{base}<mo>{dots}</mo></mover>{close}")?
        }
        let several = subscripts.next().is_some();
        let [open, close] = if several { ["<mrow>", "</mrow>"] } else { ["", ""] };
        f.write_str(open)?;
        for (index, subscript) in name.subscripts().enumerate() {
            write!(f, "{}{}", if index > 0 { MARKS.comma } else { "" }, Part(subscript))?;
        }
        f.write_str(close)?;
        match above {
            Above::Nothing => {}
            Above::Power(exponent) => write!(f, "<mn>{exponent}</mn>")?,
            Above::Primes(primes) => write!(f, "<mo>{primes}</mo>")?,
            Above::Order(order) => write!(f, "<mrow><mo>(</mo><mn>{order}</mn><mo>)</mo></mrow>")?,
        }
        if element.is_empty() { Ok(()) } else { write!(f, "</{element}>") }
    }
}

/// A part of a name.
struct Part<'a>(&'a str);

impl fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = self.0;
        if let Some((name, number)) = numbered_greek(word) {
            return write!(f, "<msub>{}{}</msub>", Part(name), Part(number));
        }
        if let Some((_, letter)) = greek(word) {
            return write!(f, "<mi>{letter}</mi>");
        }
        if is_number(word) {
            return write!(f, "<mn>{word}</mn>");
        }
        f.write_str("<mi>")?;
        for letter in word.chars() {
            match letter {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                letter => f.write_char(letter)?,
            }
        }
        f.write_str("</mi>")
    }
}
