//! The writer of all notations: it decides on signs, fractions and brackets and calls a [`Style`].

use core::fmt::{self, Write};

use super::super::{ElementaryFunction, Formula, FormulaList, FormulaView, Terms};
use super::name::{Name, Word, greek};
use super::style::{Argument, Binding, Marks, Style, is_circular};

/// Writes a formula.
///
/// # Errors
/// That of `out`.
pub fn write(style: &dyn Style, formula: Formula<'_>, out: &mut dyn Write) -> fmt::Result {
    Writer { out, style, marks: style.marks() }.formula(formula)
}

struct Writer<'a> {
    out: &'a mut dyn Write,
    style: &'a dyn Style,
    marks: &'static Marks,
}

/// A base and an exponent; 1 for all but powers.
fn power(factor: Formula<'_>) -> (Formula<'_>, u32) {
    match factor.view() {
        FormulaView::Power(base, exponent) => (base, exponent),
        _ => (factor, 1),
    }
}

impl Writer<'_> {
    fn push(&mut self, text: &str) -> fmt::Result {
        self.out.write_str(text)
    }

    fn formula(&mut self, formula: Formula<'_>) -> fmt::Result {
        let [open, close] = self.marks.sum;
        match formula.view() {
            FormulaView::Sum(terms) => self.terms(terms),
            FormulaView::AtMost(parts) => {
                self.push(open)?;
                for (index, part) in parts.iter().enumerate() {
                    if index > 0 {
                        self.push(self.marks.at_most)?;
                    }
                    self.formula(part)?;
                }
                self.push(close)
            }
            FormulaView::NonZero(inside) => self.statement(inside, self.marks.not_zero),
            FormulaView::Exists(inside) => self.statement(inside, self.marks.exists),
            _ => self.term(formula),
        }
    }

    fn statement(&mut self, inside: Formula<'_>, end: &str) -> fmt::Result {
        let [open, close] = self.marks.sum;
        self.push(open)?;
        self.formula(inside)?;
        self.push(end)?;
        self.push(close)
    }

    fn terms(&mut self, terms: Terms<'_>) -> fmt::Result {
        self.push(self.marks.sum[0])?;
        for (index, (is_negative, term)) in terms.iter().enumerate() {
            self.push(match (index, is_negative) {
                (0, true) => self.marks.leading_minus,
                (0, false) => "",
                (_, true) => self.marks.minus,
                (_, false) => self.marks.plus,
            })?;
            self.term(term)?;
        }
        self.push(self.marks.sum[1])
    }

    fn term(&mut self, term: Formula<'_>) -> fmt::Result {
        let FormulaView::Quotient(above, below) = term.view() else { return self.product(term, Binding::Slash) };
        let is_one = !matches!(below.view(), FormulaView::Product(_));
        let [open, bar, close] = if is_one { self.marks.fraction } else { self.marks.fraction_of_many };
        let alone = if self.marks.has_bars { Binding::Sum } else { Binding::Product };
        self.push(open)?;
        self.product(above, alone)?;
        self.push(bar)?;
        self.product(below, alone)?;
        self.push(close)
    }

    /// Writes factors; a single one is put in brackets if its precedence is below `alone`.
    fn product(&mut self, product: Formula<'_>, alone: Binding) -> fmt::Result {
        let factors = match product.view() {
            FormulaView::Product(factors) => factors,
            FormulaView::Multiple(one, other) => {
                self.push(self.marks.product[0])?;
                self.factor(one, None, Binding::Product)?;
                self.push(self.marks.times_word)?;
                self.factor(other, None, Binding::Product)?;
                return self.push(self.marks.product[1]);
            }
            _ => return self.factor(product, None, alone),
        };
        self.push(self.marks.product[0])?;
        let mut last: Option<Formula<'_>> = None;
        let mut following = factors.iter().skip(1);
        for factor in factors.iter() {
            if let Some(last) = last {
                self.push(match () {
                    () if is_word(last) || is_word(factor) || is_number(factor) => self.marks.times_word,
                    () if opens_function(factor) => self.marks.times_function,
                    () => self.marks.times,
                })?;
            }
            self.factor(factor, following.next(), Binding::Product)?;
            last = Some(factor);
        }
        self.push(self.marks.product[1])
    }

    fn factor(&mut self, factor: Formula<'_>, next: Option<Formula<'_>>, at_least: Binding) -> fmt::Result {
        let (base, exponent) = power(factor);
        let is_power = exponent != 1;
        let at_least = if is_power { Binding::Atom } else { at_least };
        match base.view() {
            // The exponent of a sine follows its name; without brackets, the argument ends at the next function.
            FormulaView::Call(function, arguments) if is_circular(function) => {
                let is_next = |next: Formula<'_>| matches!(power(next).0.view(), FormulaView::Call(function, _) if is_circular(function));
                return self.call(function, arguments, exponent, next.is_none_or(is_next));
            }
            FormulaView::Name(name) if is_power && self.style.binding(name) >= at_least => {
                return self.style.power(self.out, name, exponent);
            }
            _ => {}
        }
        if is_power {
            self.push(self.marks.power)?;
        }
        match base.view() {
            FormulaView::Name(name) => {
                let bracketed = self.style.binding(name) < at_least;
                self.within(bracketed, name.is_derivative(), |writer| writer.style.name(writer.out, name))?;
            }
            FormulaView::Call(function, arguments) => self.call(function, arguments, 1, false)?,
            FormulaView::External(name, order, arguments) => self.external(name, order, arguments)?,
            FormulaView::Integer(number) => self.number(format_args!("{number}"))?,
            FormulaView::Decimal(number) => self.number(format_args!("{number:?}"))?,
            FormulaView::Pi => self.push(self.marks.pi)?,
            FormulaView::Ellipsis => self.push(self.marks.ellipsis)?,
            _ => {
                let bracketed = self.binding(base) < at_least;
                self.within(bracketed, is_tall(base), |writer| writer.formula(base))?;
            }
        }
        if is_power { self.style.exponent(self.out, exponent) } else { Ok(()) }
    }

    fn within(&mut self, brackets: bool, tall: bool, write: impl FnOnce(&mut Self) -> fmt::Result) -> fmt::Result {
        if !brackets {
            return write(self);
        }
        let [open, close] = if tall { self.marks.tall_brackets } else { self.marks.brackets };
        self.push(open)?;
        write(self)?;
        self.push(close)
    }

    /// Writes a call; its argument may omit brackets if it is the `last` factor.
    fn call(
        &mut self,
        function: ElementaryFunction,
        arguments: FormulaList<'_>,
        exponent: u32,
        last: bool,
    ) -> fmt::Result {
        let around = match function {
            ElementaryFunction::Sqrt => Some(self.marks.root),
            ElementaryFunction::Abs => Some(self.marks.modulus),
            _ => None,
        };
        let argument = match () {
            () if last && is_circular(function) && arguments.only().is_some_and(is_plain) => Argument::Bare,
            () if arguments.iter().any(is_tall) => Argument::Tall,
            () => Argument::Bracketed,
        };
        match around {
            Some([open, _]) => self.push(open)?,
            None => self.style.function(self.out, function, exponent, argument)?,
        }
        self.arguments(arguments)?;
        self.push(around.map_or_else(|| self.style.end_of_function(argument), |[_, close]| close))
    }

    fn external(&mut self, name: &str, order: u32, arguments: FormulaList<'_>) -> fmt::Result {
        let tall = arguments.iter().any(is_tall);
        self.style.external(self.out, name, order, tall)?;
        self.arguments(arguments)?;
        self.push(self.style.end_of_function(if tall { Argument::Tall } else { Argument::Bracketed }))
    }

    fn arguments(&mut self, arguments: FormulaList<'_>) -> fmt::Result {
        for (index, argument) in arguments.iter().enumerate() {
            if index > 0 {
                self.push(self.marks.comma)?;
            }
            self.formula(argument)?;
        }
        Ok(())
    }

    fn number(&mut self, number: fmt::Arguments<'_>) -> fmt::Result {
        let mut digits = Digits { bytes: [0; LONGEST_NUMBER], length: 0 };
        digits.write_fmt(number)?;
        let number = digits.text();
        let (digits, exponent) = match number.split_once('e') {
            Some((digits, exponent)) => (digits, Some(exponent)),
            None => (number, None),
        };
        self.style.number(self.out, digits.strip_suffix(".0").unwrap_or(digits), exponent)
    }

    fn binding(&self, formula: Formula<'_>) -> Binding {
        match formula.view() {
            FormulaView::Sum(_) | FormulaView::AtMost(_) | FormulaView::NonZero(_) | FormulaView::Exists(_) => {
                Binding::Sum
            }
            // a/b·c could be read as a/(b·c), and a/b/c as a/(b/c).
            FormulaView::Quotient(..) if !self.marks.has_bars => Binding::Slash,
            FormulaView::Quotient(..) | FormulaView::Product(_) | FormulaView::Multiple(..) => Binding::Product,
            FormulaView::Power(..) => Binding::Power,
            FormulaView::Name(name) => self.style.binding(name),
            FormulaView::Integer(_)
            | FormulaView::Decimal(_)
            | FormulaView::Pi
            | FormulaView::Ellipsis
            | FormulaView::Call(..)
            | FormulaView::External(..) => Binding::Atom,
        }
    }
}

/// The longest text of a double or of an integer of 64 bits, `-2.2250738585072014e-308`.
const LONGEST_NUMBER: usize = 24;

/// The text of a number.
struct Digits {
    bytes: [u8; LONGEST_NUMBER],
    length: usize,
}

impl Digits {
    fn text(&self) -> &str {
        core::str::from_utf8(&self.bytes[..self.length]).unwrap_or_default()
    }
}

impl Write for Digits {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let end = self.length + text.len();
        let room = self.bytes.get_mut(self.length..end).ok_or(fmt::Error)?;
        room.copy_from_slice(text.as_bytes());
        self.length = end;
        Ok(())
    }
}

/// True if brackets around it must be taller than a line.
fn is_tall(formula: Formula<'_>) -> bool {
    match formula.view() {
        FormulaView::Sum(terms) => terms.iter().any(|(_, term)| is_tall(term)),
        FormulaView::Product(parts) | FormulaView::AtMost(parts) | FormulaView::External(_, _, parts) => {
            parts.iter().any(is_tall)
        }
        FormulaView::Multiple(one, other) => is_tall(one) || is_tall(other),
        FormulaView::Quotient(..) => true,
        FormulaView::Power(inside, _) | FormulaView::NonZero(inside) | FormulaView::Exists(inside) => is_tall(inside),
        FormulaView::Call(ElementaryFunction::Sqrt | ElementaryFunction::Abs, _) => true,
        FormulaView::Call(_, arguments) => arguments.iter().any(is_tall),
        FormulaView::Name(name) => name.is_derivative(),
        FormulaView::Integer(_) | FormulaView::Decimal(_) | FormulaView::Pi | FormulaView::Ellipsis => false,
    }
}

/// True if it is only a coordinate, a parameter or pi.
fn is_plain(formula: Formula<'_>) -> bool {
    matches!(formula.view(), FormulaView::Name(Name::Plain(_)) | FormulaView::Pi)
}

fn is_number(factor: Formula<'_>) -> bool {
    matches!(power(factor).0.view(), FormulaView::Integer(_) | FormulaView::Decimal(_))
}

/// True for a name of several letters, also for that of a user function.
fn is_word(factor: Formula<'_>) -> bool {
    let has_letters = |name: &str| {
        let base = Word::new(name).base;
        base.chars().nth(1).is_some() && greek(base).is_none()
    };
    match power(factor).0.view() {
        FormulaView::Name(Name::Plain(name) | Name::Rate(name) | Name::Acceleration(name))
        | FormulaView::External(name, ..) => has_letters(name),
        _ => false,
    }
}

/// True if it begins with the name of a function.
fn opens_function(factor: Formula<'_>) -> bool {
    let (base, exponent) = power(factor);
    match base.view() {
        FormulaView::Call(ElementaryFunction::Sqrt | ElementaryFunction::Abs, _) => false,
        FormulaView::Call(function, _) => is_circular(function) || exponent == 1,
        FormulaView::Name(Name::Determinant(_)) => exponent == 1,
        _ => false,
    }
}
