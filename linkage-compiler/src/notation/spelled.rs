//! Names printed in all notations.

use super::formula::Formula;
use super::latex::Latex;
use super::mathml::MathMl;
use super::name::Name;
use super::style::Style;
use super::unicode::Unicode;

/// A name, printed once in all notations and reused.
#[derive(Debug)]
pub(super) struct Spelled<'a> {
    pub(super) name: Name<'a>,
    pub(super) formula: Formula,
}

impl Formula {
    /// The formula that consists of this name alone.
    #[must_use]
    pub fn of_name(name: Name<'_>) -> Self {
        let in_style = |style: &dyn Style| {
            let mut out = String::new();
            style.name(&mut out, name);
            out
        };
        Self { text: in_style(&Unicode), latex: in_style(&Latex), mathml: in_style(&MathMl) }
    }
}
