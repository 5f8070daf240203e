//! The writer of all notations: it decides what needs brackets, a [`Style`] spells the pieces.

use super::layout::{Arguments, Base, Factor, Fraction, Sum};
use super::{Formula, Name};
use crate::graph::{Function, Number};

/// The strength with which a text holds together: any neighbour tears a sum apart, none an atom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    /// A quotient written with a slash holds together in a sum, but not between other factors.
    Slash,
    Product,
    Power,
    Atom,
}

/// The signs between the pieces of a formula, around them and in their place.
pub(super) struct Marks {
    pub(super) plus: &'static str,
    pub(super) minus: &'static str,
    pub(super) leading_minus: &'static str,
    pub(super) times: &'static str,
    /// Before a function.
    pub(super) times_function: &'static str,
    pub(super) comma: &'static str,
    pub(super) not_zero: &'static str,
    pub(super) exists: &'static str,
    pub(super) pi: &'static str,
    pub(super) ellipsis: &'static str,
    pub(super) sum: [&'static str; 2],
    pub(super) product: [&'static str; 2],
    pub(super) brackets: [&'static str; 2],
    pub(super) tall_brackets: [&'static str; 2],
    pub(super) modulus: [&'static str; 2],
    pub(super) root: [&'static str; 2],
    /// Before, at and after the bar, which holds together what is above and below it.
    pub(super) fraction: [&'static str; 3],
    /// The same with several factors below.
    pub(super) fraction_of_many: [&'static str; 3],
    /// Whether fractions have a bar.
    pub(super) has_bars: bool,
    /// Before a power.
    pub(super) power: &'static str,
}

/// The spelling of the pieces of a formula.
pub(super) trait Style {
    fn marks(&self) -> &'static Marks;
    /// A finished formula in this notation.
    fn of<'f>(&self, formula: &'f Formula) -> &'f str;
    /// A number that is not negative, its power of ten apart.
    fn number(&self, out: &mut String, digits: &str, exponent: Option<&str>);
    fn name(&self, out: &mut String, name: Name<'_>);
    fn binding(&self, name: Name<'_>) -> Binding;
    /// The exponent behind the base of a power.
    fn exponent(&self, out: &mut String, exponent: u32);
    /// The name of a function, to a power unless that is 1, up to its argument.
    fn function(&self, out: &mut String, function: Function, exponent: u32, argument: Argument);
    /// The name of a user function, differentiated `order` times, up to its argument in brackets.
    fn external(&self, out: &mut String, name: &str, order: usize, tall: bool);
    /// The text behind the argument of a function.
    fn end_of_function(&self, argument: Argument) -> &'static str;

    /// A power of a name.
    fn power(&self, out: &mut String, name: Name<'_>, exponent: u32) {
        out.push_str(self.marks().power);
        self.name(out, name);
        self.exponent(out, exponent);
    }
}

/// The brackets around the argument of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Argument {
    Bare,
    Bracketed,
    /// In brackets taller than a line.
    Tall,
}

/// A statement about a formula.
#[derive(Debug, Clone, Copy)]
pub(super) enum Relation {
    NotZero,
    Exists,
}

/// Sine, cosine and tangent: their argument may go without brackets and their power is written at the name.
pub(super) fn is_circular(function: Function) -> bool {
    matches!(function, Function::Sin | Function::Cos | Function::Tan)
}

/// The name of a function in mathematics.
pub(super) fn function_name(function: Function) -> &'static str {
    match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        other => other.operation().name,
    }
}

/// Writes a formula, or a statement about it.
pub(super) fn write(style: &dyn Style, sum: &Sum<'_>, relation: Option<Relation>) -> String {
    let marks = style.marks();
    let mut writer = Writer { out: String::new(), style, marks };
    let Some(relation) = relation else {
        writer.sum(sum);
        return writer.out;
    };
    writer.push(marks.sum[0]);
    writer.sum(sum);
    writer.push(match relation {
        Relation::NotZero => marks.not_zero,
        Relation::Exists => marks.exists,
    });
    writer.push(marks.sum[1]);
    writer.out
}

struct Writer<'a> {
    out: String,
    style: &'a dyn Style,
    marks: &'static Marks,
}

impl Writer<'_> {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn sum(&mut self, sum: &Sum<'_>) {
        if let Some(only) = sum.single() {
            return self.fraction(only);
        }
        self.push(self.marks.sum[0]);
        for (index, term) in sum.terms().iter().enumerate() {
            self.push(match (index, term.is_negative) {
                (0, true) => self.marks.leading_minus,
                (0, false) => "",
                (_, true) => self.marks.minus,
                (_, false) => self.marks.plus,
            });
            self.fraction(&term.fraction);
        }
        self.push(self.marks.sum[1]);
    }

    fn fraction(&mut self, Fraction { above, below }: &Fraction<'_>) {
        let [open, bar, close] = match below.as_slice() {
            [] => return self.product(above, Binding::Slash),
            [_] => self.marks.fraction,
            _ => self.marks.fraction_of_many,
        };
        let alone = if self.marks.has_bars { Binding::Sum } else { Binding::Product };
        self.push(open);
        self.product(above, alone);
        self.push(bar);
        self.product(below, alone);
        self.push(close);
    }

    /// Factors, of which a single one holds together at least as firmly as `alone`.
    fn product(&mut self, factors: &[Factor<'_>], alone: Binding) {
        if let [only] = factors {
            return self.factor(only, None, alone);
        }
        self.push(self.marks.product[0]);
        for (index, factor) in factors.iter().enumerate() {
            if index > 0 {
                self.push(if factor.opens_function() { self.marks.times_function } else { self.marks.times });
            }
            self.factor(factor, factors.get(index + 1), Binding::Product);
        }
        self.push(self.marks.product[1]);
    }

    fn factor(&mut self, factor: &Factor<'_>, next: Option<&Factor<'_>>, at_least: Binding) {
        let at_least = if factor.is_power() { Binding::Atom } else { at_least };
        match &factor.base {
            // The power of a sine stands at its name; without brackets a function ends where the next begins.
            Base::Call(function, arguments) if is_circular(*function) => {
                let last =
                    next.is_none_or(|next| matches!(next.base, Base::Call(function, _) if is_circular(function)));
                return self.call(*function, arguments, factor.exponent, last);
            }
            Base::Name(spelled) if factor.is_power() && self.style.binding(spelled.name) >= at_least => {
                return self.style.power(&mut self.out, spelled.name, factor.exponent);
            }
            _ => {}
        }
        if factor.is_power() {
            self.push(self.marks.power);
        }
        match &factor.base {
            Base::Group(sum) => {
                let bracketed = self.binding(sum) < at_least;
                self.within(bracketed, sum.is_tall(), |writer| writer.sum(sum));
            }
            Base::Name(spelled) => {
                let bracketed = self.style.binding(spelled.name) < at_least;
                let text = self.style.of(&spelled.formula);
                self.within(bracketed, spelled.name.is_derivative(), |writer| writer.push(text));
            }
            Base::Call(function, arguments) => self.call(*function, arguments, 1, false),
            Base::External { name, order, arguments } => self.external(name, *order, arguments),
            Base::Number(number) => self.number(*number),
            Base::Pi => self.push(self.marks.pi),
            Base::Ellipsis => self.push(self.marks.ellipsis),
        }
        if factor.is_power() {
            self.style.exponent(&mut self.out, factor.exponent);
        }
    }

    fn within(&mut self, brackets: bool, tall: bool, write: impl FnOnce(&mut Self)) {
        if !brackets {
            return write(self);
        }
        let [open, close] = if tall { self.marks.tall_brackets } else { self.marks.brackets };
        self.push(open);
        write(self);
        self.push(close);
    }

    /// A call, whose argument may go without brackets if it is the `last` factor.
    fn call(&mut self, function: Function, arguments: &Arguments<'_>, exponent: u32, last: bool) {
        let around = match function {
            Function::Sqrt => Some(self.marks.root),
            Function::Abs => Some(self.marks.modulus),
            _ => None,
        };
        let is_plain = || arguments.only().and_then(Sum::single).is_some_and(Fraction::is_plain);
        let argument = match () {
            () if last && is_circular(function) && is_plain() => Argument::Bare,
            () if arguments.is_tall() => Argument::Tall,
            () => Argument::Bracketed,
        };
        match around {
            Some([open, _]) => self.push(open),
            None => self.style.function(&mut self.out, function, exponent, argument),
        }
        self.arguments(arguments);
        self.push(around.map_or_else(|| self.style.end_of_function(argument), |[_, close]| close));
    }

    fn external(&mut self, name: &str, order: usize, arguments: &Arguments<'_>) {
        let tall = arguments.is_tall();
        self.style.external(&mut self.out, name, order, tall);
        self.arguments(arguments);
        self.push(self.style.end_of_function(if tall { Argument::Tall } else { Argument::Bracketed }));
    }

    fn arguments(&mut self, arguments: &Arguments<'_>) {
        for (index, argument) in arguments.iter().enumerate() {
            if index > 0 {
                self.push(self.marks.comma);
            }
            self.sum(argument);
        }
    }

    fn number(&mut self, number: Number) {
        let number = number.to_string();
        let (digits, exponent) = match number.split_once('e') {
            Some((digits, exponent)) => (digits, Some(exponent)),
            None => (number.as_str(), None),
        };
        self.style.number(&mut self.out, digits.strip_suffix(".0").unwrap_or(digits), exponent);
    }

    fn binding(&self, sum: &Sum<'_>) -> Binding {
        let Some(Fraction { above, below }) = sum.single() else { return Binding::Sum };
        match above.as_slice() {
            // a/b·c would read as a/(b·c), and a/b/c as a/(b/c).
            _ if !below.is_empty() && !self.marks.has_bars => Binding::Slash,
            [only] if below.is_empty() => match &only.base {
                _ if only.is_power() => Binding::Power,
                Base::Name(spelled) => self.style.binding(spelled.name),
                Base::Group(sum) => self.binding(sum),
                _ => Binding::Atom,
            },
            _ => Binding::Product,
        }
    }
}

impl Factor<'_> {
    /// Whether it begins with the name of a function.
    fn opens_function(&self) -> bool {
        match &self.base {
            Base::Call(Function::Sqrt | Function::Abs, _) => false,
            Base::Call(function, _) => is_circular(*function) || !self.is_power(),
            Base::Name(spelled) => matches!(spelled.name, Name::Determinant(_)) && !self.is_power(),
            _ => false,
        }
    }
}
