//! What a notation must be able to spell.

use crate::graph::{Function, Number};

use super::Name;

/// How firmly a text holds together, from what any neighbour tears apart to what none does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    /// A name written with a slash: one in a sum, but not beside other factors.
    Slash,
    Product,
    Power,
    Atom,
}

/// The pieces of a notation. Bodies that come in are written already and bracketed as they need.
pub(super) trait Style {
    /// Whether fractions have a bar, which holds together what is above and below it.
    fn has_bars(&self) -> bool;
    /// An integer or float that is not negative.
    fn number(&self, value: Number) -> String;
    fn pi(&self) -> &'static str;
    fn ellipsis(&self) -> &'static str;
    fn name(&self, name: Name) -> (String, Binding);
    fn brackets(&self, body: &str) -> String;
    /// Terms, and whether each is negative; there may be a single one.
    fn sum(&self, terms: &[(bool, String)]) -> String;
    /// At least two factors.
    fn product(&self, factors: &[String]) -> String;
    /// `above` over the product of `below`, which is not empty.
    fn quotient(&self, above: &str, below: &[String]) -> String;
    /// An exponent of at least two.
    fn power(&self, base: &str, exponent: u32) -> String;
    /// A function to a power of at least one; `bare` if its argument may go without brackets.
    fn call(&self, function: Function, arguments: &[String], exponent: u32, bare: bool) -> String;
    /// A derivative of a function of the user's; `names` are those of the value and of its derivatives.
    fn external(&self, names: &[String], order: usize, arguments: &[String]) -> String;
}

/// As many primes, if that many are written.
pub(super) fn primes(order: usize) -> Option<&'static str> {
    ["", "′", "″", "‴"].get(order).copied()
}

/// The functions whose argument may go without brackets and whose power is written at the name.
pub(super) fn is_circular(function: Function) -> bool {
    matches!(function, Function::Sin | Function::Cos | Function::Tan)
}

/// The name of a function in mathematics, where it differs from the language's.
pub(super) fn function_name(function: Function) -> &'static str {
    match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        _ => function.operation().name,
    }
}

/// The digits of a number that is not negative, and its power of ten.
pub(super) fn digits(value: Number) -> (String, Option<String>) {
    let text = value.to_string();
    match text.split_once('e') {
        Some((mantissa, exponent)) => (mantissa.to_owned(), Some(exponent.to_owned())),
        None => (text.strip_suffix(".0").unwrap_or(&text).to_owned(), None),
    }
}
