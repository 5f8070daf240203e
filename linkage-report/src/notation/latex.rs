//! LaTeX's mathematical mode; `atan2` and `hypot` need `amsmath`.

use std::fmt::{self, Write};

use linkage_runtime::derivation::ElementaryFunction;
use linkage_runtime::derivation::notation::{
    Argument, Binding, Marks, Name, Style, Word, greek, is_circular, is_number, latin, numbered_greek, primes,
};

pub(super) struct Latex;

const MARKS: Marks = Marks {
    plus: " + ",
    minus: " - ",
    leading_minus: "-",
    times: " ",
    times_word: " \\cdot ",
    times_function: " ",
    comma: ", ",
    at_most: " \\leq ",
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
        match exponent {
            Some(exponent) => write!(out, " \\cdot 10^{{{exponent}}}"),
            None => Ok(()),
        }
    }

    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result {
        match name {
            Name::Plain(name) => write!(out, "{}", plain(name)),
            Name::Rate(name) => write!(out, "{}", Accented(name, "\\dot")),
            Name::Acceleration(name) => write!(out, "{}", Accented(name, "\\ddot")),
            Name::Ratio { of, by } => write!(out, "\\frac{{\\partial {}}}{{\\partial {}}}", plain(of), plain(by)),
            Name::RatioDerivative { of, by: [first, second] } if first == second => {
                write!(out, "\\frac{{\\partial^2 {}}}{{\\partial {{{}}}^2}}", plain(of), plain(first))
            }
            Name::RatioDerivative { of, by: [first, second] } => {
                let [of, first, second] = [of, first, second].map(plain);
                write!(out, "\\frac{{\\partial^2 {of}}}{{\\partial {first} \\partial {second}}}")
            }
            Name::Determinant(matrix) => write!(out, "\\det {}", plain(matrix)),
            Name::Inverse(matrix) => write!(out, "{}^{{-1}}", plain(matrix)),
        }
    }

    fn binding(&self, name: Name<'_>) -> Binding {
        match name {
            Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) => Binding::Product,
            _ => Binding::Atom,
        }
    }

    fn exponent(&self, out: &mut dyn Write, exponent: u32) -> fmt::Result {
        if exponent < 10 { write!(out, "^{exponent}") } else { write!(out, "^{{{exponent}}}") }
    }

    fn function(
        &self,
        out: &mut dyn Write,
        function: ElementaryFunction,
        exponent: u32,
        argument: Argument,
    ) -> fmt::Result {
        let name = function.in_mathematics();
        match function {
            ElementaryFunction::Atan2 | ElementaryFunction::Hypot => write!(out, "\\operatorname{{{name}}}")?,
            ElementaryFunction::IfNonzero => out.write_str("\\operatorname{if\\_nonzero}")?,
            _ => write!(out, "\\{name}")?,
        }
        if exponent != 1 && is_circular(function) {
            self.exponent(out, exponent)?;
        }
        out.write_str(match argument {
            Argument::Bare => " ",
            Argument::Bracketed => MARKS.brackets[0],
            Argument::Tall => MARKS.tall_brackets[0],
        })
    }

    fn external(&self, out: &mut dyn Write, name: &str, order: u32, tall: bool) -> fmt::Result {
        write!(out, "{}", plain(name))?;
        match primes(order) {
            Some(_) => (0..order).try_for_each(|_| out.write_char('\''))?,
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

/// A name without an accent.
fn plain(name: &str) -> Accented<'_> {
    Accented(name, "")
}

/// A name, and the command of the accent of its base.
struct Accented<'a>(&'a str, &'static str);

impl fmt::Display for Accented<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(name, accent) = *self;
        let name = Word::new(name);
        let base = Part(name.base);
        if accent.is_empty() {
            write!(f, "{base}")?
        } else {
            write!(f, "{accent}{{{base}}}")?
        }
        let mut subscripts = name.subscripts();
        let Some(first) = subscripts.next() else { return Ok(()) };
        let mut others = subscripts.peekable();
        if first.len() == 1 && is_number(first) && others.peek().is_none() {
            return write!(f, "_{first}");
        }
        write!(f, "_{{{}", Part(first))?;
        for other in others {
            write!(f, ",{}", Part(other))?;
        }
        f.write_char('}')
    }
}

/// A part of a name.
struct Part<'a>(&'a str);

impl fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = self.0;
        if let Some((name, number)) = numbered_greek(word) {
            return write!(f, "{}_{{{number}}}", Part(name));
        }
        match greek(word) {
            Some((name, _)) => match latin(name) {
                Some(letter) => write!(f, "\\mathrm{{{letter}}}"),
                None => write!(f, "\\{name}"),
            },
            None if is_number(word) || word.chars().count() == 1 => f.write_str(word),
            None => write!(f, "\\mathrm{{{word}}}"),
        }
    }
}
