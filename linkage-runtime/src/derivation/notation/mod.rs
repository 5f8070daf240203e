//! Formulas in mathematical notation, written from their source.
//!
//! [`source`] takes a formula apart; [`Writer`] decides what needs brackets and a [`Style`] spells
//! the pieces.

mod latex;
mod mathml;
mod name;
mod source;
mod unicode;

use core::fmt;

use name::Name;
use source::{Base, Factor, Fraction, Product, Sum, arguments};

/// A mathematical notation.
#[derive(Debug, Clone, Copy)]
pub(super) enum Notation {
    /// One line of plain text.
    Unicode,
    /// For LaTeX's mathematical mode.
    Latex,
    /// Presentation MathML: one element.
    MathMl,
}

/// How firmly a text holds together, from what any neighbour tears apart to what none does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    /// A name written with a slash: one in a sum, but not beside other factors.
    Slash,
    Product,
    Power,
    Atom,
}

/// What stands between the pieces of a formula, about them and in their place.
struct Marks {
    plus: &'static str,
    minus: &'static str,
    leading_minus: &'static str,
    times: &'static str,
    /// Before a function.
    times_function: &'static str,
    comma: &'static str,
    not_zero: &'static str,
    exists: &'static str,
    pi: &'static str,
    ellipsis: &'static str,
    sum: [&'static str; 2],
    product: [&'static str; 2],
    brackets: [&'static str; 2],
    tall_brackets: [&'static str; 2],
    modulus: [&'static str; 2],
    root: [&'static str; 2],
    /// Before, at and after the bar, which holds together what is above and below it.
    fraction: [&'static str; 3],
    /// The same with several factors below.
    fraction_of_many: [&'static str; 3],
    /// Whether fractions have a bar.
    has_bars: bool,
    /// Before a power.
    power: &'static str,
}

/// How the pieces of a formula are spelled.
trait Style {
    fn marks(&self) -> &'static Marks;
    /// A number that is not negative, its power of ten apart.
    fn number(&self, out: &mut dyn fmt::Write, digits: &str, exponent: Option<&str>) -> fmt::Result;
    fn name(&self, out: &mut dyn fmt::Write, name: Name<'_>) -> fmt::Result;
    fn binding(&self, name: Name<'_>) -> Binding;
    /// What follows the base of a power.
    fn exponent(&self, out: &mut dyn fmt::Write, exponent: &str) -> fmt::Result;
    /// The name of a function, to a power unless that is 1, up to its argument.
    fn function(&self, out: &mut dyn fmt::Write, name: &str, exponent: &str, argument: Argument) -> fmt::Result;
    /// The name of a function of the user's, derived so often, up to its argument in brackets.
    fn external(&self, out: &mut dyn fmt::Write, name: &str, order: usize, tall: bool) -> fmt::Result;
    /// What follows the argument of a function.
    fn end_of_function(&self, argument: Argument) -> &'static str;

    /// A power of a name.
    fn power(&self, out: &mut dyn fmt::Write, name: Name<'_>, exponent: &str) -> fmt::Result {
        out.write_str(self.marks().power)?;
        self.name(out, name)?;
        self.exponent(out, exponent)
    }
}

/// How the argument of a function stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Argument {
    Bare,
    Bracketed,
    /// In brackets taller than a line.
    Tall,
}

/// The functions whose argument may go without brackets and whose power is written at the name.
fn is_circular(function: &str) -> bool {
    matches!(function, "sin" | "cos" | "tan")
}

/// The name of a function in mathematics.
fn function_name(function: &str) -> &str {
    match function {
        "asin" => "arcsin",
        "acos" => "arccos",
        "atan" => "arctan",
        other => other,
    }
}

/// Writes the formula that has this source.
pub(super) fn write(out: &mut dyn fmt::Write, notation: Notation, source: &str) -> fmt::Result {
    let style: &dyn Style = match notation {
        Notation::Unicode => &unicode::Unicode,
        Notation::Latex => &latex::Latex,
        Notation::MathMl => &mathml::MathMl,
    };
    let marks = style.marks();
    let (formula, relation) = match (source.strip_suffix(" != 0"), source.strip_suffix(" exists")) {
        (Some(formula), _) => (formula, marks.not_zero),
        (_, Some(formula)) => (formula, marks.exists),
        _ => (source, ""),
    };
    let mut writer = Writer { out, style, marks };
    if relation.is_empty() {
        return writer.sum(Sum(formula));
    }
    writer.out.write_str(marks.sum[0])?;
    writer.sum(Sum(formula))?;
    writer.out.write_str(relation)?;
    writer.out.write_str(marks.sum[1])
}

struct Writer<'a> {
    out: &'a mut dyn fmt::Write,
    style: &'a dyn Style,
    marks: &'static Marks,
}

impl Writer<'_> {
    fn sum(&mut self, sum: Sum<'_>) -> fmt::Result {
        if let Some(only) = sum.single() {
            return self.fraction(only);
        }
        self.out.write_str(self.marks.sum[0])?;
        for (index, (negative, term)) in sum.terms().enumerate() {
            self.out.write_str(match (index, negative) {
                (0, true) => self.marks.leading_minus,
                (0, false) => "",
                (_, true) => self.marks.minus,
                (_, false) => self.marks.plus,
            })?;
            self.fraction(term)?;
        }
        self.out.write_str(self.marks.sum[1])
    }

    fn fraction(&mut self, Fraction { above, below }: Fraction<'_>) -> fmt::Result {
        let Some(below) = below else { return self.product(above, Binding::Slash) };
        let alone = if self.marks.has_bars { Binding::Sum } else { Binding::Product };
        let [open, bar, close] = if below.is_single() { self.marks.fraction } else { self.marks.fraction_of_many };
        self.out.write_str(open)?;
        self.product(above, alone)?;
        self.out.write_str(bar)?;
        self.product(below, alone)?;
        self.out.write_str(close)
    }

    /// Factors, of which a single one holds together at least as firmly as `alone`.
    fn product(&mut self, product: Product<'_>, alone: Binding) -> fmt::Result {
        let mut factors = product.factors().peekable();
        if product.is_single() {
            return factors.next().map_or(Ok(()), |factor| self.factor(factor, None, alone));
        }
        self.out.write_str(self.marks.product[0])?;
        let mut first = true;
        while let Some(factor) = factors.next() {
            if !first {
                self.out.write_str(if factor.opens_function() {
                    self.marks.times_function
                } else {
                    self.marks.times
                })?;
            }
            first = false;
            self.factor(factor, factors.peek().copied(), Binding::Product)?;
        }
        self.out.write_str(self.marks.product[1])
    }

    fn factor(&mut self, factor: Factor<'_>, next: Option<Factor<'_>>, at_least: Binding) -> fmt::Result {
        let Factor { base, exponent } = factor;
        let at_least = if factor.is_power() { Binding::Atom } else { at_least };
        match base {
            // The power of a sine stands at its name; without brackets a function ends where the next begins.
            Base::Call { function, arguments } if is_circular(function) => {
                let last =
                    next.is_none_or(|next| matches!(next.base, Base::Call { function, .. } if is_circular(function)));
                return self.call(function, arguments, exponent, last);
            }
            Base::Name(name) if factor.is_power() && self.style.binding(name) >= at_least => {
                return self.style.power(self.out, name, exponent);
            }
            _ => {}
        }
        if factor.is_power() {
            self.out.write_str(self.marks.power)?;
        }
        match base {
            Base::Group(sum) => {
                let bracketed = self.binding(sum) < at_least;
                self.within(bracketed, sum.is_tall(), |writer| writer.sum(sum))
            }
            Base::Name(name) => {
                let bracketed = self.style.binding(name) < at_least;
                let tall = matches!(name, Name::Ratio { .. } | Name::RatioDerivative { .. });
                self.within(bracketed, tall, |writer| writer.style.name(writer.out, name))
            }
            Base::Call { function, arguments } => self.call(function, arguments, "1", false),
            Base::External { name, order, arguments } => self.external(name, order, arguments),
            Base::Number(number) => {
                let (digits, exponent) = number.split_once('e').map_or((number, None), |(m, e)| (m, Some(e)));
                self.style.number(self.out, digits.strip_suffix(".0").unwrap_or(digits), exponent)
            }
            Base::Pi => self.out.write_str(self.marks.pi),
            Base::Ellipsis => self.out.write_str(self.marks.ellipsis),
        }?;
        if factor.is_power() { self.style.exponent(self.out, exponent) } else { Ok(()) }
    }

    fn within(&mut self, brackets: bool, tall: bool, write: impl FnOnce(&mut Self) -> fmt::Result) -> fmt::Result {
        if !brackets {
            return write(self);
        }
        let [open, close] = if tall { self.marks.tall_brackets } else { self.marks.brackets };
        self.out.write_str(open)?;
        write(self)?;
        self.out.write_str(close)
    }

    /// A call, whose argument may go without brackets if it is the `last` factor.
    fn call(&mut self, function: &str, of: &str, exponent: &str, last: bool) -> fmt::Result {
        let around = match function {
            "sqrt" => Some(self.marks.root),
            "abs" => Some(self.marks.modulus),
            _ => None,
        };
        let argument = match Sum(of).single() {
            Some(argument) if last && is_circular(function) && argument.is_plain() => Argument::Bare,
            _ if Sum(of).is_tall() => Argument::Tall,
            _ => Argument::Bracketed,
        };
        match around {
            Some([open, _]) => self.out.write_str(open)?,
            None => self.style.function(self.out, function, exponent, argument)?,
        }
        self.arguments(of)?;
        self.out.write_str(around.map_or_else(|| self.style.end_of_function(argument), |[_, close]| close))
    }

    fn external(&mut self, name: &str, order: usize, of: &str) -> fmt::Result {
        let tall = Sum(of).is_tall();
        self.style.external(self.out, name, order, tall)?;
        self.arguments(of)?;
        self.out.write_str(self.style.end_of_function(if tall { Argument::Tall } else { Argument::Bracketed }))
    }

    fn arguments(&mut self, of: &str) -> fmt::Result {
        for (index, argument) in arguments(of).enumerate() {
            if index > 0 {
                self.out.write_str(self.marks.comma)?;
            }
            self.sum(Sum(argument))?;
        }
        Ok(())
    }

    fn binding(&self, sum: Sum<'_>) -> Binding {
        let Some(only) = sum.single() else { return Binding::Sum };
        let factor = only.above.factors().next();
        match factor {
            _ if only.below.is_some() || !only.above.is_single() => Binding::Product,
            Some(factor) if factor.is_power() => Binding::Power,
            Some(Factor { base: Base::Name(name), .. }) => self.style.binding(name),
            Some(Factor { base: Base::Group(sum), .. }) => self.binding(sum),
            _ => Binding::Atom,
        }
    }
}

impl Fraction<'_> {
    /// Whether it is a name of the user's or pi alone.
    fn is_plain(self) -> bool {
        let mut factors = self.above.factors();
        let plain =
            |factor: Factor<'_>| !factor.is_power() && matches!(factor.base, Base::Name(Name::Plain(_)) | Base::Pi);
        self.below.is_none() && factors.next().is_some_and(plain) && factors.next().is_none()
    }
}

impl Factor<'_> {
    /// Whether it begins with the name of a function.
    fn opens_function(self) -> bool {
        match self.base {
            Base::Call { function, .. } => {
                !matches!(function, "sqrt" | "abs") && (is_circular(function) || !self.is_power())
            }
            Base::Name(Name::Determinant(_)) => !self.is_power(),
            _ => false,
        }
    }
}
