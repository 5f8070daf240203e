//! Presentation MathML, of the Core subset. Every body is one element.

use crate::graph::{Function, Number};

use super::Name;
use super::style::{Binding, Style, digits, function_name, is_circular, primes};

/// U+2062, which separates factors for readers that speak.
const INVISIBLE_TIMES: &str = "<mo>\u{2062}</mo>";
/// The same before a function, whose name needs room.
const SPACED_TIMES: &str = "<mo rspace=\"0.17em\">\u{2062}</mo>";
/// U+2061.
const FUNCTION_APPLICATION: &str = "<mo>\u{2061}</mo>";
/// The same before an argument without brackets.
const SPACED_APPLICATION: &str = "<mo rspace=\"0.17em\">\u{2061}</mo>";

pub(super) struct MathMl;

impl Style for MathMl {
    fn has_bars(&self) -> bool {
        true
    }

    fn number(&self, value: Number) -> String {
        match digits(value) {
            (digits, None) => format!("<mn>{digits}</mn>"),
            (digits, Some(exponent)) => {
                let exponent = match exponent.strip_prefix('-') {
                    Some(positive) => format!("<mrow><mo>−</mo><mn>{positive}</mn></mrow>"),
                    None => format!("<mn>{exponent}</mn>"),
                };
                format!("<mrow><mn>{digits}</mn><mo>⋅</mo><msup><mn>10</mn>{exponent}</msup></mrow>")
            }
        }
    }

    fn pi(&self) -> &'static str {
        "<mi>π</mi>"
    }

    fn ellipsis(&self) -> &'static str {
        "<mi>…</mi>"
    }

    fn name(&self, name: Name) -> (String, Binding) {
        let binding = match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        };
        (name.mathml(), binding)
    }

    fn brackets(&self, body: &str) -> String {
        format!("<mrow><mo>(</mo>{body}<mo>)</mo></mrow>")
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        let mut text = String::from("<mrow>");
        for (index, (negative, body)) in terms.iter().enumerate() {
            text.push_str(match (index, negative) {
                (_, true) => "<mo>−</mo>",
                (0, false) => "",
                (_, false) => "<mo>+</mo>",
            });
            text.push_str(body);
        }
        text + "</mrow>"
    }

    fn product(&self, factors: &[String]) -> String {
        let mut text = String::from("<mrow>");
        for (index, factor) in factors.iter().enumerate() {
            let is_function = ["<mrow><mi>", "<mrow><msup><mi>"].iter().any(|start| factor.starts_with(start));
            text.push_str(match (index, is_function) {
                (0, _) => "",
                (_, true) => SPACED_TIMES,
                (_, false) => INVISIBLE_TIMES,
            });
            text.push_str(factor);
        }
        text + "</mrow>"
    }

    fn quotient(&self, above: &str, below: &[String]) -> String {
        match below {
            [one] => format!("<mfrac>{above}{one}</mfrac>"),
            many => format!("<mfrac>{above}{}</mfrac>", self.product(many)),
        }
    }

    fn power(&self, base: &str, exponent: u32) -> String {
        // An index and an exponent stand above each other.
        match base.strip_prefix("<msub>").and_then(|inner| inner.strip_suffix("</msub>")) {
            Some(inner) => format!("<msubsup>{}<mn>{exponent}</mn></msubsup>", lowered(inner)),
            None => format!("<msup>{}<mn>{exponent}</mn></msup>", lowered(base)),
        }
    }

    fn call(&self, function: Function, arguments: &[String], exponent: u32, bare: bool) -> String {
        let arguments = arguments.join("<mo>,</mo>");
        match function {
            Function::Sqrt => return format!("<msqrt>{arguments}</msqrt>"),
            Function::Abs => return format!("<mrow><mo>|</mo>{arguments}<mo>|</mo></mrow>"),
            _ => {}
        }
        let name = format!("<mi>{}</mi>", function_name(function));
        let name = if exponent > 1 && is_circular(function) { self.power(&name, exponent) } else { name };
        if bare {
            return format!("<mrow>{name}{SPACED_APPLICATION}{arguments}</mrow>");
        }
        format!("<mrow>{name}{FUNCTION_APPLICATION}{}</mrow>", self.brackets(&arguments))
    }

    fn external(&self, names: &[String], order: usize, arguments: &[String]) -> String {
        let name = names.first().map(|name| Name::Plain(name).mathml()).unwrap_or_default();
        let arguments = self.brackets(&arguments.join("<mo>,</mo>"));
        let above = match primes(order) {
            Some(primes) => format!("<mo>{primes}</mo>"),
            None => self.brackets(&format!("<mn>{order}</mn>")),
        };
        let name = match (order, name.strip_prefix("<msub>").and_then(|inner| inner.strip_suffix("</msub>"))) {
            (0, _) => name,
            (_, Some(inner)) => format!("<msubsup>{inner}{above}</msubsup>"),
            (_, None) => format!("<msup>{name}{above}</msup>"),
        };
        format!("<mrow>{name}{FUNCTION_APPLICATION}{arguments}</mrow>")
    }
}

/// Dots above a letter do not lift its exponent.
fn lowered(base: &str) -> String {
    match base.strip_prefix("<mover>").and_then(|inner| inner.split_once("</mover>")) {
        Some((dotted, rest)) => format!("<mpadded height=\"0.75em\"><mover>{dotted}</mover></mpadded>{rest}"),
        None => base.to_owned(),
    }
}

/// Text for the inside of an element.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
