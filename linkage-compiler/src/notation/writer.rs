//! The writer of all notations: it decides on brackets and calls a [`Style`].

use super::layout::{Arguments, Base, Factor, Fraction, Sum};
use super::name::{Name, Word, greek};
use super::style::{Argument, Binding, Marks, Style, is_circular};
use crate::graph::{Function, Number};

/// A relation of a formula to zero or to its domain.
#[derive(Debug, Clone, Copy)]
pub(super) enum Relation {
    NotZero,
    Exists,
}

/// Writes a formula, or a relation.
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

    /// Writes factors; a single one is put in brackets if its precedence is below `alone`.
    fn product(&mut self, factors: &[Factor<'_>], alone: Binding) {
        if let [only] = factors {
            return self.factor(only, None, alone);
        }
        self.push(self.marks.product[0]);
        for (index, factor) in factors.iter().enumerate() {
            if index > 0 {
                let is_word = factors[index - 1].is_word() || factor.is_word();
                self.push(match () {
                    () if is_word || matches!(factor.base, Base::Number(_)) => self.marks.times_word,
                    () if factor.opens_function() => self.marks.times_function,
                    () => self.marks.times,
                });
            }
            self.factor(factor, factors.get(index + 1), Binding::Product);
        }
        self.push(self.marks.product[1]);
    }

    fn factor(&mut self, factor: &Factor<'_>, next: Option<&Factor<'_>>, at_least: Binding) {
        let at_least = if factor.is_power() { Binding::Atom } else { at_least };
        match &factor.base {
            // The exponent of a sine follows its name; without brackets, the argument ends at the next function.
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

    /// Writes a call; its argument may omit brackets if it is the `last` factor.
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
            // a/b·c could be read as a/(b·c), and a/b/c as a/(b/c).
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
    /// True if it begins with the name of a function.
    /// True for a name of several letters, also for that of a user function.
    fn is_word(&self) -> bool {
        let has_letters = |name: &str| {
            let base = Word::new(name).base;
            base.chars().nth(1).is_some() && greek(base).is_none()
        };
        match &self.base {
            Base::Name(spelled) => match spelled.name {
                Name::Plain(name) | Name::Rate(name) | Name::Acceleration(name) => has_letters(name),
                Name::Ratio { .. } | Name::RatioDerivative { .. } | Name::Determinant(_) | Name::Inverse(_) => false,
            },
            Base::External { name, .. } => has_letters(name),
            _ => false,
        }
    }

    fn opens_function(&self) -> bool {
        match &self.base {
            Base::Call(Function::Sqrt | Function::Abs, _) => false,
            Base::Call(function, _) => is_circular(*function) || !self.is_power(),
            Base::Name(spelled) => matches!(spelled.name, Name::Determinant(_)) && !self.is_power(),
            _ => false,
        }
    }
}
