//! Formulas as LaTeX, MathML and FPCore.

mod fpcore;
mod latex;
mod mathml;

pub(crate) use fpcore::literal;

use linkage_runtime::derivation::Formula;
use linkage_runtime::derivation::notation::{Style, write};

/// The notations of a formula besides its `Display`, which is Unicode.
///
/// ```
/// use linkage::{Notation, linkage};
///
/// linkage! {
///     mechanism Crank {
///         param r;
///         input phi;
///         point Pin = r@phi;
///     }
/// }
/// let x = Crank::<f64>::DERIVATION.points[0].value[0].right;
/// assert_eq!(x.to_string(), "r·cos(φ)");
/// assert_eq!(x.to_latex(), r"r \cos \phi");
/// ```
pub trait Notation {
    /// LaTeX for mathematical mode, with `amsmath`.
    fn to_latex(&self) -> String;
    /// Presentation MathML: one element, without the `math` element around it.
    fn to_mathml(&self) -> String;
    /// An expression of FPCore, with the operations in their order, for formulas of [`KernelCode`]: their names are
    /// symbols of FPCore.
    ///
    /// [`KernelCode`]: linkage_runtime::derivation::KernelCode
    fn to_fpcore(&self) -> String;
}

impl Notation for Formula<'_> {
    fn to_latex(&self) -> String {
        in_style(&latex::Latex, *self)
    }

    fn to_mathml(&self) -> String {
        in_style(&mathml::MathMl, *self)
    }

    fn to_fpcore(&self) -> String {
        fpcore::expression(*self)
    }
}

fn in_style(style: &dyn Style, formula: Formula<'_>) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(style, formula, &mut text);
    text
}
