//! The style of a notation: how it spells the pieces of a formula.

use super::formula::Formula;
use super::name::Name;
use crate::graph::Function;

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
    /// True if fractions have a bar.
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
