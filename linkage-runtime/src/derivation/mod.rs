//! A mechanism's derivation as data: every formula as text, LaTeX and MathML.
//!
//! The compiler writes each [`Formula`] in all three notations, so that nothing is parsed or laid out at run time.

mod scene;

use core::fmt;

pub use scene::{ContactEffect, Effect, JointForce, SceneDerivation};

/// A formula. Its [`Display`](fmt::Display) is the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Formula {
    /// One line of Unicode: `−l₃·l₄·sin(θ₃ − θ₄)`.
    pub text: &'static str,
    /// LaTeX for mathematical mode, with `amsmath`.
    pub latex: &'static str,
    /// Presentation MathML: one element, without the `math` element around it.
    pub mathml: &'static str,
}

/// A parameter or coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Symbol {
    /// The name in the `linkage!` language: `theta3`.
    pub name: &'static str,
    /// The displayed name: θ₃.
    pub formula: Formula,
}

/// `left` = `right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Equation {
    /// The left side.
    pub left: Formula,
    /// The right side.
    pub right: Formula,
}

/// An entry of a [`FormulaMatrix`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FormulaMatrix {
    /// The name.
    pub name: Formula,
    /// A factor of every entry, written before the brackets.
    pub factor: Option<Formula>,
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The entries that are not zero.
    pub entries: &'static [Entry],
}

/// The method that solves the linear system of a [`Block`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum BlockMethod {
    /// The inverse by formula: the adjugate divided by the determinant.
    ClosedForm,
    /// LU factorisation with partial pivoting.
    Factorization,
}

/// The root that tells the two solutions of a [`Block`] apart by its sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Root {
    /// The root.
    pub formula: Formula,
    /// The names of the branches on which it is positive and negative.
    pub branches: [&'static str; 2],
}

/// Unknowns that are solved for together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Block {
    /// The unknowns.
    pub unknowns: &'static [Formula],
    /// The constraint equations that determine them: indices of [`Derivation::residual`].
    pub equations: &'static [usize],
    /// The Assur group, or a description of any other block.
    pub group: &'static str,
    /// The position in closed form, each equation in terms of those before it; empty if Newton's method finds it.
    pub position: &'static [Equation],
    /// The root that tells two solutions apart.
    pub root: Option<Root>,
    /// The method that solves the linear system.
    pub method: BlockMethod,
    /// The determinant of the block of J, if it has a formula.
    pub determinant: Option<Equation>,
    /// The inverse of the block of J, if it has a formula.
    pub inverse: Option<FormulaMatrix>,
}

/// A point or output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Quantity {
    /// The name in the `linkage!` language.
    pub name: &'static str,
    /// The components.
    pub value: &'static [Equation],
    /// The derivatives of the components with respect to the inputs.
    pub ratios: &'static [Equation],
    /// The second derivatives of the components with respect to the inputs; empty unless the mechanism requests them.
    pub ratio_derivatives: &'static [Equation],
    /// The derivatives of the components with respect to the parameters, without those that are zero; empty unless the
    /// mechanism requests them.
    pub sensitivities: &'static [Equation],
}

/// The derivatives of the unknowns with respect to the parameters while the inputs are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sensitivity {
    /// ∂Ψ/∂p, the columns in the order of the parameters.
    pub jacobian: FormulaMatrix,
    /// ∂u/∂p if it has a formula, without the derivatives that are zero.
    pub formulas: &'static [Equation],
}

/// The operation counts of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Kernel {
    /// The name of the function.
    pub function: &'static str,
    /// The operations of one call. What the function has in common with others that are inlined in it counts once.
    pub operations: Operations,
    /// With `derive fpcore`, the formulas that it computes, in the order of its operations and in the notation of
    /// FPCore, a line each: `let` a name and its value, `check` a condition and its numbers, `return` a place in the
    /// result and its value. It is empty for a function without formulas, such as one that iterates. `Document::fpcore`
    /// of the crate `linkage` makes files of it.
    pub lines: &'static str,
}

/// The kinematics of a mechanism, derived from its constraint equations Ψ(u, v) = 0, where u are the unknowns and v the
/// inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Derivation {
    /// The mechanism, or the driver of one.
    pub mechanism: &'static str,
    /// The parameters.
    pub parameters: &'static [Symbol],
    /// The inputs v.
    pub inputs: &'static [Symbol],
    /// The unknowns u.
    pub unknowns: &'static [Symbol],
    /// Ψ, the residuals of the constraint equations.
    pub residual: &'static [Equation],
    /// The residuals of loops and equations that are declared as implied by the others.
    pub implied: &'static [Equation],
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
    /// ∂²u/∂v∂v, if it has a formula and the mechanism requests it.
    pub ratio_derivatives: Option<&'static [Equation]>,
    /// γ, the quadratic velocity terms: the second time derivative of Ψ without the terms of accelerations.
    pub gamma: &'static [Equation],
    /// η: the third time derivative of Ψ without the terms of jerks; none unless the mechanism requests the jerk.
    pub jerk: Option<&'static [Equation]>,
    /// The sensitivities to the parameters; none unless the mechanism requests them.
    pub sensitivity: Option<Sensitivity>,
    /// The points and their derivatives.
    pub points: &'static [Quantity],
    /// The outputs and their derivatives.
    pub outputs: &'static [Quantity],
    /// The conditions under which the simplified formulas hold, such as l₄ ≠ 0.
    pub conditions: &'static [Formula],
    /// The emitted functions.
    pub kernels: &'static [Kernel],
}

impl FormulaMatrix {
    /// Returns an entry, or none if it is zero; both indices count from 0.
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> Option<Formula> {
        self.entries.iter().find(|entry| (entry.row, entry.column) == (row, column)).map(|entry| entry.value)
    }
}

impl BlockMethod {
    /// Describes the method, to follow the word "solved".
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
