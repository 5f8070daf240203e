//! A mechanism's derivation as data: every formula as text, LaTeX and MathML.
//!
//! The compiler writes each [`Formula`] in all three notations, so that nothing is parsed or laid out at run time.

mod scene;

use core::fmt;

pub use scene::{Effect, SceneDerivation};

/// A formula. Its [`Display`](fmt::Display) is the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formula {
    /// One line of Unicode: `−l₃·l₄·sin(θ₃ − θ₄)`.
    pub text: &'static str,
    /// For LaTeX's mathematical mode, with `amsmath`.
    pub latex: &'static str,
    /// Presentation MathML: one element, without the `math` element around it.
    pub mathml: &'static str,
}

/// A parameter or coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Symbol {
    /// The name in the `linkage!` language: `theta3`.
    pub name: &'static str,
    /// The name as it is shown: θ₃.
    pub formula: Formula,
}

/// `left` = `right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Equation {
    /// What is given a value.
    pub left: Formula,
    /// Its value.
    pub right: Formula,
}

/// An entry of a [`FormulaMatrix`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// The row, counted from 0.
    pub row: usize,
    /// The column, counted from 0.
    pub column: usize,
    /// The entry itself.
    pub value: Formula,
}

/// A matrix of formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormulaMatrix {
    /// What it is called.
    pub name: Formula,
    /// What stands before the brackets and multiplies every entry.
    pub factor: Option<Formula>,
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The entries; those that are absent are zero.
    pub entries: &'static [Entry],
}

/// How the linear system of a [`Block`] is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum BlockMethod {
    /// By formula: the adjugate over the determinant.
    ClosedForm,
    /// By a factorisation with partial pivoting.
    Factorization,
}

/// Unknowns that are solved for together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block {
    /// The unknowns.
    pub unknowns: &'static [Formula],
    /// The closure equations that determine them: indices of [`Derivation::residual`].
    pub equations: &'static [usize],
    /// The Assur group that the block is, or what else it is, in words.
    pub group: &'static str,
    /// How the linear system is solved.
    pub method: BlockMethod,
    /// The determinant of the block of J, where there is a formula.
    pub determinant: Option<Equation>,
    /// The inverse of the block of J, where there is a formula.
    pub inverse: Option<FormulaMatrix>,
}

/// A point or output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    /// The name in the `linkage!` language.
    pub name: &'static str,
    /// Its components.
    pub value: &'static [Equation],
    /// The derivatives of its components with respect to the inputs.
    pub ratios: &'static [Equation],
    /// The second derivatives of its components with respect to the inputs; like what follows empty unless
    /// the mechanism asks for them.
    pub ratio_derivatives: &'static [Equation],
    /// The derivatives of its components with respect to the parameters, but for those that are zero.
    pub sensitivities: &'static [Equation],
}

/// How the unknowns follow the parameters while the inputs are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sensitivity {
    /// ∂Ψ/∂p, the columns in the order of the parameters.
    pub jacobian: FormulaMatrix,
    /// ∂u/∂p where there is a formula, but for those that are zero.
    pub formulas: &'static [Equation],
}

/// What a function computes, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Calls of elementary functions such as sine.
    pub functions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Additions and subtractions.
    pub additions: usize,
}

/// An emitted function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kernel {
    /// The name of the function.
    pub function: &'static str,
    /// What one call of it costs.
    pub operations: Operations,
}

/// How the kinematics of a mechanism follow from its closure equations Ψ(u, v) = 0, where u are the
/// unknowns and v the inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Derivation {
    /// The mechanism, or the driver of one.
    pub mechanism: &'static str,
    /// What is given.
    pub parameters: &'static [Symbol],
    /// The driven coordinates v.
    pub inputs: &'static [Symbol],
    /// The coordinates u that follow.
    pub unknowns: &'static [Symbol],
    /// Ψ, which is zero where the mechanism closes.
    pub residual: &'static [Equation],
    /// J = ∂Ψ/∂u.
    pub jacobian_unknowns: FormulaMatrix,
    /// A = ∂Ψ/∂v.
    pub jacobian_inputs: FormulaMatrix,
    /// The blocks, in the order in which they are solved.
    pub blocks: &'static [Block],
    /// det J, the product of the determinants of the blocks; none if a block has no formula.
    pub determinant: Option<Equation>,
    /// The velocity ratios ∂u/∂v.
    pub ratios: &'static [Equation],
    /// ∂²u/∂v∂v where there is a formula; none unless the mechanism asks for them.
    pub ratio_derivatives: Option<&'static [Equation]>,
    /// γ: what is left of the second derivative of Ψ where no coordinate accelerates.
    pub gamma: &'static [Equation],
    /// η: what is left of the third derivative of Ψ where no coordinate jerks; none unless the mechanism asks
    /// for the jerk.
    pub jerk: Option<&'static [Equation]>,
    /// None unless the mechanism asks for it.
    pub sensitivity: Option<Sensitivity>,
    /// Points and how they move.
    pub points: &'static [Quantity],
    /// Outputs and how they change.
    pub outputs: &'static [Quantity],
    /// What simplification took for granted, such as l₄ ≠ 0.
    pub conditions: &'static [Formula],
    /// The emitted functions.
    pub kernels: &'static [Kernel],
}

impl FormulaMatrix {
    /// The entry there, unless it is zero; both indices count from 0.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> Option<Formula> {
        self.entries.iter().find(|entry| (entry.row, entry.column) == (row, column)).map(|entry| entry.value)
    }
}

impl BlockMethod {
    /// The method in words, to follow "solved".
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::ClosedForm => "in closed form",
            Self::Factorization => "by factorisation with partial pivoting",
        }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)
    }
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.left, self.right)
    }
}
