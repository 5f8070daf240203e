//! The trait of a notation.

use core::fmt::{self, Write};

use super::super::ElementaryFunction;
use super::name::Name;

/// The precedence of the outermost operator of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Binding {
    /// A sum or a statement.
    Sum,
    /// A quotient with a slash: needs brackets between factors, but not in a sum.
    Slash,
    /// A product, or a fraction with a bar.
    Product,
    /// A power.
    Power,
    /// All else.
    Atom,
}

/// The texts of operators and brackets in a notation.
pub struct Marks {
    /// A sign between terms.
    pub plus: &'static str,
    /// The sign of a term that is subtracted.
    pub minus: &'static str,
    /// The sign of a first term that is subtracted.
    pub leading_minus: &'static str,
    /// The sign between factors.
    pub times: &'static str,
    /// The multiplication sign next to a word, and before a number: without a sign, `rod lever` is read as one word.
    pub times_word: &'static str,
    /// The multiplication sign before a function.
    pub times_function: &'static str,
    /// The sign between arguments.
    pub comma: &'static str,
    /// The sign of `a ≤ b`.
    pub at_most: &'static str,
    /// The end of `a ≠ 0`.
    pub not_zero: &'static str,
    /// The end of "a exists".
    pub exists: &'static str,
    /// π.
    pub pi: &'static str,
    /// The sign of a part that is left out.
    pub ellipsis: &'static str,
    /// The texts around terms.
    pub sum: [&'static str; 2],
    /// The texts around factors.
    pub product: [&'static str; 2],
    /// Brackets.
    pub brackets: [&'static str; 2],
    /// Brackets taller than a line.
    pub tall_brackets: [&'static str; 2],
    /// The texts around the argument of a modulus.
    pub modulus: [&'static str; 2],
    /// The texts around the argument of a square root.
    pub root: [&'static str; 2],
    /// The texts before, at and after the bar of a fraction.
    pub fraction: [&'static str; 3],
    /// The texts of a fraction with several factors in the denominator.
    pub fraction_of_many: [&'static str; 3],
    /// True if fractions have a bar.
    pub has_bars: bool,
    /// The text before a power.
    pub power: &'static str,
}

/// A notation: prints the parts of a formula.
pub trait Style {
    /// The texts of its operators.
    fn marks(&self) -> &'static Marks;
    /// Prints a non-negative number with an optional power of ten.
    fn number(&self, out: &mut dyn Write, digits: &str, exponent: Option<&str>) -> fmt::Result;
    /// Prints a name.
    fn name(&self, out: &mut dyn Write, name: Name<'_>) -> fmt::Result;
    /// The precedence of a printed name.
    fn binding(&self, name: Name<'_>) -> Binding;
    /// Prints the exponent of a power.
    fn exponent(&self, out: &mut dyn Write, exponent: u32) -> fmt::Result;
    /// Prints the name of a function, with an exponent unless that is 1, up to its argument.
    fn function(
        &self,
        out: &mut dyn Write,
        function: ElementaryFunction,
        exponent: u32,
        argument: Argument,
    ) -> fmt::Result;
    /// Prints the name of a user function or of its derivative of this order, up to its argument in brackets.
    fn external(&self, out: &mut dyn Write, name: &str, order: u32, tall: bool) -> fmt::Result;
    /// The text after the argument of a function.
    fn end_of_function(&self, argument: Argument) -> &'static str;

    /// Prints a power of a name.
    fn power(&self, out: &mut dyn Write, name: Name<'_>, exponent: u32) -> fmt::Result {
        out.write_str(self.marks().power)?;
        self.name(out, name)?;
        self.exponent(out, exponent)
    }
}

/// The brackets around the argument of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Argument {
    /// Without brackets.
    Bare,
    /// In brackets.
    Bracketed,
    /// In brackets taller than a line.
    Tall,
}

/// True for sine, cosine and tangent, which may omit brackets and have exponents at their names.
#[must_use]
pub fn is_circular(function: ElementaryFunction) -> bool {
    matches!(function, ElementaryFunction::Sin | ElementaryFunction::Cos | ElementaryFunction::Tan)
}
