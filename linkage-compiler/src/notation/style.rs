//! The trait of a notation.

use super::formula::Formula;
use super::name::Name;
use crate::graph::Function;

/// The precedence of the outermost operator of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    /// A quotient with a slash: needs brackets between factors, but not in a sum.
    Slash,
    Product,
    Power,
    Atom,
}

/// The texts of operators and brackets in a notation.
pub(super) struct Marks {
    pub(super) plus: &'static str,
    pub(super) minus: &'static str,
    pub(super) leading_minus: &'static str,
    pub(super) times: &'static str,
    /// The multiplication sign next to a word, and before a number: without a sign, `rod lever` is read as one word.
    pub(super) times_word: &'static str,
    /// The multiplication sign before a function.
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
    /// The texts before, at and after the bar of a fraction.
    pub(super) fraction: [&'static str; 3],
    /// The texts of a fraction with several factors in the denominator.
    pub(super) fraction_of_many: [&'static str; 3],
    /// True if fractions have a bar.
    pub(super) has_bars: bool,
    /// The text before a power.
    pub(super) power: &'static str,
}

/// A notation: prints the parts of a formula.
pub(super) trait Style {
    fn marks(&self) -> &'static Marks;
    /// Selects this notation of a formula.
    fn of<'f>(&self, formula: &'f Formula) -> &'f str;
    /// Prints a non-negative number with an optional power of ten.
    fn number(&self, out: &mut String, digits: &str, exponent: Option<&str>);
    fn name(&self, out: &mut String, name: Name<'_>);
    fn binding(&self, name: Name<'_>) -> Binding;
    /// Prints the exponent of a power.
    fn exponent(&self, out: &mut String, exponent: u32);
    /// Prints the name of a function, with an exponent unless that is 1, up to its argument.
    fn function(&self, out: &mut String, function: Function, exponent: u32, argument: Argument);
    /// Prints the name of a user function or of its derivative of this order, up to its argument in brackets.
    fn external(&self, out: &mut String, name: &str, order: usize, tall: bool);
    /// The text after the argument of a function.
    fn end_of_function(&self, argument: Argument) -> &'static str;

    /// Prints a power of a name.
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

/// True for sine, cosine and tangent, which may omit brackets and have exponents at their names.
pub(super) fn is_circular(function: Function) -> bool {
    matches!(function, Function::Sin | Function::Cos | Function::Tan)
}

/// The usual name of a function in mathematics.
pub(super) fn function_name(function: Function) -> &'static str {
    match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        other => other.operation().name,
    }
}
