//! LaTeX's mathematical mode; `atan2` and `hypot` need `amsmath`.

use super::formula::Formula;
use super::name::{Name, Word, greek, is_number, latin, matrix_name, numbered_greek, primes};
use super::style::{Argument, Binding, Marks, Style, function_name, is_circular};
use crate::graph::Function;

pub(super) struct Latex;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " - ",
    leading_minus: "-",
    times: " ",
    times_word: " \\cdot ",
    times_function: " ",
    comma: ", ",
    not_zero: " \\neq 0",
    exists: " \\text{ exists}",
    pi: "\\pi",
    ellipsis: "\\ldots",
    sum: ["", ""],
    product: ["", ""],
    brackets: ["(", ")"],
    tall_brackets: ["\\left(", "\\right)"],
    modulus: ["\\left|", "\\right|"],
    root: ["\\sqrt{", "}"],
    fraction: ["\\frac{", "}{", "}"],
    fraction_of_many: ["\\frac{", "}{", "}"],
    has_bars: true,
    power: "",
};

impl Style for Latex {
    fn marks(&self) -> &'static Marks {
        &MARKS
    }

    fn of<'f>(&self, formula: &'f Formula) -> &'f str {
        &formula.latex
    }

    fn number(&self, out: &mut String, digits: &str, exponent: Option<&str>) {
        out.push_str(digits);
        if let Some(exponent) = exponent {
            out.extend([" \\cdot 10^{", exponent, "}"]);
        }
    }

    fn name(&self, out: &mut String, name: Name<'_>) {
        match name {
            Name::Plain(name) => word(out, name, ""),
            Name::Rate(name) => word(out, name, "\\dot"),
            Name::Acceleration(name) => word(out, name, "\\ddot"),
            Name::Ratio { of, by } => {
                out.push_str("\\frac{\\partial ");
                word(out, of, "");
                out.push_str("}{\\partial ");
                word(out, by, "");
                out.push('}');
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.push_str("\\frac{\\partial^2 ");
                word(out, of, "");
                if first == second {
                    out.push_str("}{\\partial {");
                    word(out, first, "");
                    return out.push_str("}^2}");
                }
                out.push_str("}{\\partial ");
                word(out, first, "");
                out.push_str(" \\partial ");
                word(out, second, "");
                out.push('}');
            }
            Name::Determinant(block) => {
                out.push_str("\\det ");
                word(out, &matrix_name(block), "");
            }
            Name::Inverse(block) => {
                word(out, &matrix_name(block), "");
                out.push_str("^{-1}");
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
        out.push_str(&if exponent < 10 { format!("^{exponent}") } else { format!("^{{{exponent}}}") });
    }

    fn function(&self, out: &mut String, function: Function, exponent: u32, argument: Argument) {
        let name = function_name(function);
        match function {
            Function::Atan2 | Function::Hypot => out.extend(["\\operatorname{", name, "}"]),
            Function::IfNonzero => out.push_str("\\operatorname{if\\_nonzero}"),
            _ => out.extend(["\\", name]),
        }
        if exponent != 1 && is_circular(function) {
            self.exponent(out, exponent);
        }
        out.push_str(match argument {
            Argument::Bare => " ",
            Argument::Bracketed => MARKS.brackets[0],
            Argument::Tall => MARKS.tall_brackets[0],
        })
    }

    fn external(&self, out: &mut String, name: &str, order: usize, tall: bool) {
        word(out, name, "");
        match primes(order) {
            Some(_) => out.extend(std::iter::repeat_n('\'', order)),
            None => out.push_str(&format!("^{{({order})}}")),
        }
        out.push_str(if tall { MARKS.tall_brackets[0] } else { MARKS.brackets[0] });
    }

    fn end_of_function(&self, argument: Argument) -> &'static str {
        match argument {
            Argument::Bare => "",
            Argument::Bracketed => MARKS.brackets[1],
            Argument::Tall => MARKS.tall_brackets[1],
        }
    }
}

fn word(out: &mut String, name: &str, accent: &str) {
    let name = Word::new(name);
    if accent.is_empty() {
        part(out, name.base);
    } else {
        out.extend([accent, "{"]);
        part(out, name.base);
        out.push('}');
    }
    let mut subscripts = name.subscripts();
    let Some(first) = subscripts.next() else { return };
    let mut others = subscripts.peekable();
    if first.len() == 1 && is_number(first) && others.peek().is_none() {
        return out.extend(["_", first]);
    }
    out.push_str("_{");
    part(out, first);
    for other in others {
        out.push(',');
        part(out, other);
    }
    out.push('}');
}

fn part(out: &mut String, word: &str) {
    if let Some((name, number)) = numbered_greek(word) {
        part(out, name);
        return out.extend(["_{", number, "}"]);
    }
    match greek(word) {
        Some((name, _)) => match latin(name) {
            Some(letter) => out.push_str(&format!("\\mathrm{{{letter}}}")),
            None => out.extend(["\\", name]),
        },
        None if is_number(word) || word.chars().count() == 1 => out.push_str(word),
        None => out.extend(["\\mathrm{", word, "}"]),
    }
}
