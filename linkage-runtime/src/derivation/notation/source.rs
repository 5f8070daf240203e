//! The source of a formula, taken apart.
//!
//! It is one line in the notation of the `linkage!` language, as the compiler lays it out:
//!
//! ```text
//! sum      = ["-"] fraction { (" + " | " - ") fraction }
//! fraction = product ["/" (factor | "(" product ")")]
//! product  = factor { "*" factor }
//! factor   = base ["^" digits]
//! base     = "(" sum ")" | function "(" sum { ", " sum } ")" | number | name | "pi" | "…"
//! function = word { "'" }
//! name     = word ["'" ["'"]] | "∂(" word ", " word [", " word] ")" | "|" word "|" | word "^-1"
//! ```
//!
//! x' and x'' are the derivatives of x with respect to time, f' and f'' those of a function of the user's;
//! `∂(x, y)` is ∂x/∂y and `∂(x, y, z)` ∂²x/∂y∂z; |J| and J^-1 are the determinant and the inverse of J.

use super::Name;

/// The functions of the language.
const FUNCTIONS: [&str; 12] =
    ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs", "exp", "ln", "hypot"];

/// A sum, without brackets about it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sum<'a>(pub(super) &'a str);

/// A term of a sum, without its sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fraction<'a> {
    pub(super) above: Product<'a>,
    pub(super) below: Option<Product<'a>>,
}

/// Factors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Product<'a>(&'a str);

/// A base and its exponent, which is at least 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Factor<'a> {
    pub(super) base: Base<'a>,
    pub(super) exponent: &'a str,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Base<'a> {
    Group(Sum<'a>),
    Call {
        function: &'a str,
        arguments: &'a str,
    },
    /// A function of the user's, derived so often.
    External {
        name: &'a str,
        order: usize,
        arguments: &'a str,
    },
    Number(&'a str),
    Name(Name<'a>),
    Pi,
    Ellipsis,
}

/// Where one of `signs` stands outside all brackets, and how long it is.
fn outermost(text: &str, signs: &[&str]) -> Option<(usize, usize)> {
    let mut depth = 0_usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            // All signs are ASCII, so that no letter of several bytes is mistaken for one.
            _ if depth == 0 => {
                let here = &text.as_bytes()[at..];
                if let Some(sign) = signs.iter().find(|sign| here.starts_with(sign.as_bytes())) {
                    return Some((at, sign.len()));
                }
            }
            _ => {}
        }
    }
    None
}

/// What stands before the first of the signs, what stands there, and what follows.
fn split<'a>(text: &'a str, signs: &[&str]) -> (&'a str, &'a str, &'a str) {
    match outermost(text, signs) {
        Some((at, length)) => (&text[..at], &text[at..at + length], &text[at + length..]),
        None => (text, "", ""),
    }
}

/// What is inside of the brackets that are the whole of a text.
fn inside(text: &str) -> Option<&str> {
    let inner = text.strip_prefix('(')?.strip_suffix(')')?;
    // (a)*(b) begins and ends with brackets as well.
    let mut depth = 0_i32;
    for byte in inner.bytes() {
        depth += i32::from(byte == b'(') - i32::from(byte == b')');
        if depth < 0 {
            return None;
        }
    }
    Some(inner)
}

/// The arguments of a call, or what else is separated by commas.
pub(super) fn arguments(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    core::iter::from_fn(move || {
        let (first, comma, others) = split(rest?, &[", "]);
        rest = (!comma.is_empty()).then_some(others);
        Some(first)
    })
}

impl<'a> Sum<'a> {
    /// The terms, and whether each is negative.
    pub(super) fn terms(self) -> impl Iterator<Item = (bool, Fraction<'a>)> {
        let (mut negative, mut rest) = match self.0.strip_prefix('-') {
            Some(rest) => (true, Some(rest)),
            None => (false, Some(self.0)),
        };
        core::iter::from_fn(move || {
            let (term, sign, others) = split(rest?, &[" + ", " - "]);
            rest = (!sign.is_empty()).then_some(others);
            Some((core::mem::replace(&mut negative, sign == " - "), Fraction::new(term)))
        })
    }

    /// The one term, if it has no sign.
    pub(super) fn single(self) -> Option<Fraction<'a>> {
        let mut terms = self.terms();
        match (terms.next(), terms.next()) {
            (Some((false, only)), None) => Some(only),
            _ => None,
        }
    }

    /// Whether its brackets must be taller than a line.
    pub(super) fn is_tall(self) -> bool {
        ["/", "∂(", "sqrt(", "abs("].iter().any(|tall| self.0.contains(tall))
    }
}

impl<'a> Fraction<'a> {
    fn new(text: &'a str) -> Self {
        let (above, slash, below) = split(text, &["/"]);
        let below = (!slash.is_empty()).then(|| match inside(below).and_then(|inner| Sum(inner).single()) {
            Some(Fraction { above, below: None }) => above,
            _ => Product(below),
        });
        Self { above: Product(above), below }
    }
}

impl<'a> Product<'a> {
    pub(super) fn factors(self) -> impl Iterator<Item = Factor<'a>> + Clone {
        let mut rest = Some(self.0);
        core::iter::from_fn(move || {
            let (factor, star, others) = split(rest?, &["*"]);
            rest = (!star.is_empty()).then_some(others);
            Some(Factor::new(factor))
        })
    }

    pub(super) fn is_single(self) -> bool {
        outermost(self.0, &["*"]).is_none()
    }
}

impl<'a> Factor<'a> {
    fn new(text: &'a str) -> Self {
        let (base, _, exponent) = split(text, &["^"]);
        match exponent {
            "" => Self { base: Base::new(base), exponent: "1" },
            "-1" => Self { base: Base::Name(Name::Inverse(base)), exponent: "1" },
            _ => Self { base: Base::new(base), exponent },
        }
    }

    pub(super) fn is_power(self) -> bool {
        self.exponent != "1"
    }
}

impl<'a> Base<'a> {
    fn new(text: &'a str) -> Self {
        if let Some(inner) = inside(text) {
            return Self::Group(Sum(inner));
        }
        if let Some(matrix) = text.strip_prefix('|').and_then(|rest| rest.strip_suffix('|')) {
            return Self::Name(Name::Determinant(matrix));
        }
        match text.split_once('(') {
            Some((function, rest)) => {
                let arguments = rest.strip_suffix(')').unwrap_or(rest);
                match (function, Name::derivative(arguments)) {
                    ("∂", Some(name)) => Self::Name(name),
                    _ if FUNCTIONS.contains(&function) => Self::Call { function, arguments },
                    _ => {
                        let name = function.trim_end_matches('\'');
                        Self::External { name, order: function.len() - name.len(), arguments }
                    }
                }
            }
            None if text.starts_with(|c: char| c.is_ascii_digit()) => Self::Number(text),
            None if text == "pi" => Self::Pi,
            None if text == "…" => Self::Ellipsis,
            None => Self::Name(Name::word(text)),
        }
    }
}
