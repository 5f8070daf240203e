//! Presentation MathML, in the subset MathML Core. Every formula is one element.

use super::formula::Formula;
use super::name::{Name, Word, greek, is_number, matrix_name, numbered_greek, primes};
use super::style::{Argument, Binding, Marks, Style, function_name, is_circular};
use crate::graph::Function;

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

    fn of<'f>(&self, formula: &'f Formula) -> &'f str {
        &formula.mathml
    }

    fn number(&self, out: &mut String, digits: &str, exponent: Option<&str>) {
        let Some(exponent) = exponent else { return out.extend(["<mn>", digits, "</mn>"]) };
        out.extend(["<mrow><mn>", digits, "</mn><mo>⋅</mo><msup><mn>10</mn>"]);
        match exponent.strip_prefix('-') {
            Some(positive) => out.extend(["<mrow><mo>−</mo><mn>", positive, "</mn></mrow>"]),
            None => out.push_str(&format!("<mn>{exponent}</mn>")),
        }
        out.push_str("</msup></mrow>");
    }

    fn name(&self, out: &mut String, name: Name<'_>) {
        let side = |out: &mut String, name: &str| {
            out.push_str("<mrow><mo>∂</mo>");
            word(out, name, Shape::PLAIN);
            out.push_str("</mrow>");
        };
        match name {
            Name::Plain(name) => word(out, name, Shape::PLAIN),
            Name::Rate(name) => word(out, name, Shape { dots: "˙", ..Shape::PLAIN }),
            Name::Acceleration(name) => word(out, name, Shape { dots: "¨", ..Shape::PLAIN }),
            Name::Ratio { of, by } => {
                out.push_str("<mfrac>");
                side(out, of);
                side(out, by);
                out.push_str("</mfrac>");
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.push_str("<mfrac><mrow><msup><mo>∂</mo><mn>2</mn></msup>");
                word(out, of, Shape::PLAIN);
                out.push_str("</mrow><mrow><mo>∂</mo>");
                if first == second {
                    out.push_str("<msup><mrow>");
                    word(out, first, Shape::PLAIN);
                    out.push_str("</mrow><mn>2</mn></msup>");
                } else {
                    word(out, first, Shape::PLAIN);
                    out.push_str("<mo>∂</mo>");
                    word(out, second, Shape::PLAIN);
                }
                out.push_str("</mrow></mfrac>");
            }
            Name::Determinant(block) => {
                out.push_str("<mrow><mi>det</mi><mo rspace=\"0.17em\">\u{2061}</mo>");
                word(out, &matrix_name(block), Shape::PLAIN);
                out.push_str("</mrow>");
            }
            Name::Inverse(block) => {
                out.push_str("<msup>");
                word(out, &matrix_name(block), Shape::PLAIN);
                out.push_str("<mrow><mo>−</mo><mn>1</mn></mrow></msup>");
            }
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut String, exponent: u32) {
        out.push_str(&format!("<mn>{exponent}</mn></msup>"));
    }

    fn function(&self, out: &mut String, function: Function, exponent: u32, argument: Argument) {
        out.push_str("<mrow>");
        let shown = function_name(function);
        if exponent != 1 && is_circular(function) {
            out.push_str(&format!("<msup><mi>{shown}</mi><mn>{exponent}</mn></msup>"));
        } else {
            out.extend(["<mi>", shown, "</mi>"]);
        }
        if argument == Argument::Bare {
            return out.push_str(SPACED_APPLICATION);
        }
        out.push_str(FUNCTION_APPLICATION);
        out.push_str(MARKS.brackets[0]);
    }

    fn external(&self, out: &mut String, name: &str, order: usize, _tall: bool) {
        let above = match (order, primes(order)) {
            (0, _) => Above::Nothing,
            (_, Some(primes)) => Above::Primes(primes),
            (_, None) => Above::Order(order),
        };
        out.push_str("<mrow>");
        word(out, name, Shape { dots: "", above });
        out.push_str(FUNCTION_APPLICATION);
        out.push_str(MARKS.brackets[0]);
    }

    fn end_of_function(&self, argument: Argument) -> &'static str {
        if argument == Argument::Bare { "</mrow>" } else { "<mo>)</mo></mrow></mrow>" }
    }

    fn power(&self, out: &mut String, name: Name<'_>, exponent: u32) {
        let (name, dots) = match name {
            Name::Plain(name) => (name, ""),
            Name::Rate(name) => (name, "˙"),
            Name::Acceleration(name) => (name, "¨"),
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) | Name::Inverse(_) => {
                out.push_str(MARKS.power);
                self.name(out, name);
                return self.exponent(out, exponent);
            }
        };
        word(out, name, Shape { dots, above: Above::Power(exponent) });
    }
}

/// The marks above a name.
#[derive(Clone, Copy)]
struct Shape<'a> {
    dots: &'a str,
    above: Above<'a>,
}

#[derive(Clone, Copy)]
enum Above<'a> {
    Nothing,
    Power(u32),
    Primes(&'a str),
    Order(usize),
}

impl Shape<'_> {
    const PLAIN: Self = Self { dots: "", above: Above::Nothing };
}

/// Writes a name; subscript and exponent are aligned.
fn word(out: &mut String, name: &str, Shape { dots, above }: Shape<'_>) {
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
        out.extend(["<", element, ">"]);
    }
    // The exponent must not be raised by the dots above the letter.
    let lowered = !dots.is_empty() && !bare;
    if lowered {
        out.push_str("<mpadded height=\"0.75em\">");
    }
    if dots.is_empty() {
        part(out, name.base);
    } else {
        out.push_str("<mover>");
        part(out, name.base);
        out.extend(["<mo>", dots, "</mo></mover>"]);
    }
    if lowered {
        out.push_str("</mpadded>");
    }
    let several = subscripts.next().is_some();
    if several {
        out.push_str("<mrow>");
    }
    for (index, subscript) in name.subscripts().enumerate() {
        if index > 0 {
            out.push_str(MARKS.comma);
        }
        part(out, subscript);
    }
    if several {
        out.push_str("</mrow>");
    }
    match above {
        Above::Nothing => {}
        Above::Power(exponent) => out.push_str(&format!("<mn>{exponent}</mn>")),
        Above::Primes(primes) => out.extend(["<mo>", primes, "</mo>"]),
        Above::Order(order) => out.push_str(&format!("<mrow><mo>(</mo><mn>{order}</mn><mo>)</mo></mrow>")),
    }
    if !element.is_empty() {
        out.extend(["</", element, ">"]);
    }
}

fn part(out: &mut String, word: &str) {
    if let Some((name, number)) = numbered_greek(word) {
        out.push_str("<msub>");
        part(out, name);
        part(out, number);
        return out.push_str("</msub>");
    }
    if let Some((_, letter)) = greek(word) {
        return out.push_str(&format!("<mi>{letter}</mi>"));
    }
    if is_number(word) {
        return out.extend(["<mn>", word, "</mn>"]);
    }
    out.push_str("<mi>");
    for letter in word.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            letter => out.push(letter),
        }
    }
    out.push_str("</mi>");
}
