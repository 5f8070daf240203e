//! A formula in all notations.

/// A formula in all notations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Formula {
    /// One line of Unicode: `−l₃·l₄·sin(θ₃ − θ₄)`.
    pub text: String,
    /// For LaTeX's mathematical mode, with `amsmath`.
    pub latex: String,
    /// Presentation MathML: one element, without the `math` element around it.
    pub mathml: String,
}
