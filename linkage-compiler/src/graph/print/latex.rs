//! LaTeX's mathematical mode; `atan2` and `hypot` need `amsmath`.

use crate::graph::{Function, Number};

use super::Name;
use super::style::{Binding, Style, digits, function_name, is_circular, primes};

pub(super) struct Latex;

impl Style for Latex {
    fn has_bars(&self) -> bool {
        true
    }

    fn number(&self, value: Number) -> String {
        match digits(value) {
            (digits, None) => digits,
            (digits, Some(exponent)) => format!("{digits} \\cdot 10^{{{exponent}}}"),
        }
    }

    fn pi(&self) -> &'static str {
        "\\pi"
    }

    fn ellipsis(&self) -> &'static str {
        "\\ldots"
    }

    fn name(&self, name: Name) -> (String, Binding) {
        let binding = match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        };
        (name.latex(), binding)
    }

    fn brackets(&self, body: &str) -> String {
        let tall = ["\\frac", "\\sqrt", "\\left"].iter().any(|tall| body.contains(tall));
        if tall { format!("\\left({body}\\right)") } else { format!("({body})") }
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        super::language::join(terms, '-')
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" ")
    }

    fn quotient(&self, above: &str, below: &[String]) -> String {
        format!("\\frac{{{above}}}{{{}}}", self.product(below))
    }

    fn power(&self, base: &str, exponent: u32) -> String {
        if exponent < 10 { format!("{base}^{exponent}") } else { format!("{base}^{{{exponent}}}") }
    }

    fn call(&self, function: Function, arguments: &[String], exponent: u32, bare: bool) -> String {
        let arguments = arguments.join(", ");
        let name = match function {
            Function::Sqrt => return format!("\\sqrt{{{arguments}}}"),
            Function::Abs => return format!("\\left|{arguments}\\right|"),
            Function::Atan2 | Function::Hypot => format!("\\operatorname{{{}}}", function_name(function)),
            _ => format!("\\{}", function_name(function)),
        };
        let name = if exponent > 1 && is_circular(function) { self.power(&name, exponent) } else { name };
        if bare { format!("{name} {arguments}") } else { format!("{name}{}", self.brackets(&arguments)) }
    }

    fn external(&self, names: &[String], order: usize, arguments: &[String]) -> String {
        let name = names.first().map(|name| Name::Plain(name).latex()).unwrap_or_default();
        let order = primes(order).map_or_else(|| format!("^{{({order})}}"), |_| "'".repeat(order));
        format!("{name}{order}{}", self.brackets(&arguments.join(", ")))
    }
}
