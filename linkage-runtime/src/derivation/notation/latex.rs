//! LaTeX's mathematical mode; `atan2` and `hypot` need `amsmath`.

use core::fmt::{self, Write};

use super::name::{Name, Word, greek, is_number, latin, primes};
use super::{Argument, Binding, Marks, Style, function_name, is_circular};

pub(super) struct Latex;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " - ",
    leading_minus: "-",
    times: " ",
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

    fn number(&self, out: &mut dyn Write, digits: &str, exponent: Option<&str>) -> fmt::Result {
        out.write_str(digits)?;
        exponent.map_or(Ok(()), |exponent| write!(out, " \\cdot 10^{{{exponent}}}"))
    }

    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result {
        match name {
            Name::Plain(name) => word(out, name, ""),
            Name::Rate(name) => word(out, name, "\\dot"),
            Name::Acceleration(name) => word(out, name, "\\ddot"),
            Name::Ratio { of, by } => {
                out.write_str("\\frac{\\partial ")?;
                word(out, of, "")?;
                out.write_str("}{\\partial ")?;
                word(out, by, "")?;
                out.write_str("}")
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                out.write_str("\\frac{\\partial^2 ")?;
                word(out, of, "")?;
                if first == second {
                    out.write_str("}{\\partial {")?;
                    word(out, first, "")?;
                    return out.write_str("}^2}");
                }
                out.write_str("}{\\partial ")?;
                word(out, first, "")?;
                out.write_str(" \\partial ")?;
                word(out, second, "")?;
                out.write_str("}")
            }
            Name::Determinant(matrix) => {
                out.write_str("\\det ")?;
                word(out, matrix, "")
            }
            Name::Inverse(matrix) => {
                word(out, matrix, "")?;
                out.write_str("^{-1}")
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
        if exponent.len() == 1 { write!(out, "^{exponent}") } else { write!(out, "^{{{exponent}}}") }
    }

    fn function(&self, out: &mut dyn Write, name: &str, exponent: &str, argument: Argument) -> fmt::Result {
        match name {
            "atan2" | "hypot" => write!(out, "\\operatorname{{{name}}}")?,
            _ => write!(out, "\\{}", function_name(name))?,
        }
        if exponent != "1" && is_circular(name) {
            self.exponent(out, exponent)?;
        }
        out.write_str(match argument {
            Argument::Bare => " ",
            Argument::Bracketed => MARKS.brackets[0],
            Argument::Tall => MARKS.tall_brackets[0],
        })
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: usize, tall: bool) -> fmt::Result {
        word(out, name, "")?;
        match primes(order) {
            Some(_) => (0..order).try_for_each(|_| out.write_str("'"))?,
            None => write!(out, "^{{({order})}}")?,
        }
        out.write_str(if tall { MARKS.tall_brackets[0] } else { MARKS.brackets[0] })
    }

    fn end_of_function(&self, argument: Argument) -> &'static str {
        match argument {
            Argument::Bare => "",
            Argument::Bracketed => MARKS.brackets[1],
            Argument::Tall => MARKS.tall_brackets[1],
        }
    }
}

fn word(out: &mut dyn Write, name: &str, accent: &str) -> fmt::Result {
    let name = Word::new(name);
    if accent.is_empty() {
        part(out, name.base)?;
    } else {
        write!(out, "{accent}{{")?;
        part(out, name.base)?;
        out.write_str("}")?;
    }
    let mut subscripts = name.subscripts();
    let Some(first) = subscripts.next() else { return Ok(()) };
    let mut others = subscripts.peekable();
    if first.len() == 1 && is_number(first) && others.peek().is_none() {
        return write!(out, "_{first}");
    }
    out.write_str("_{")?;
    part(out, first)?;
    for other in others {
        out.write_str(",")?;
        part(out, other)?;
    }
    out.write_str("}")
}

fn part(out: &mut dyn Write, word: &str) -> fmt::Result {
    match greek(word) {
        Some((name, _)) => match latin(name) {
            Some(letter) => write!(out, "\\mathrm{{{letter}}}"),
            None => write!(out, "\\{name}"),
        },
        None if is_number(word) || word.chars().count() == 1 => out.write_str(word),
        None => write!(out, "\\mathrm{{{word}}}"),
    }
}
