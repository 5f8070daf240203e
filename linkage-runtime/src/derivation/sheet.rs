//! The formulas of an analysis by hand.

use super::{Equation, Formula, FormulaMatrix};

/// The formulas of an analysis by hand, line by line, of a mechanism with `derive sheet`. With Ψ′ = J·u′ + A·v′, the second
/// derivative is Ψ″ = J·u″ + A·v″ + J′·u′ + A′·v′.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SheetDerivation<'a> {
    /// The mechanism, or the driver of one.
    pub mechanism: &'a str,
    /// J′ and A′, the derivatives of J and A with respect to time.
    pub jacobian_rates: [FormulaMatrix<'a>; 2],
    /// ∂(J·u′)/∂u and ∂(A·v′)/∂v: they are J′ and A′ if J does not depend on v, nor A on u.
    pub jacobians_of_rates: [FormulaMatrix<'a>; 2],
    /// H1 = A·v″, H2 = J′·(W·v′), H3 = A′·v′, and their sum H0.
    pub terms: [FormulaMatrix<'a>; 4],
    /// The parts of γ: quadratic in u′, quadratic in v′, and bilinear in both.
    pub gamma: [FormulaMatrix<'a>; 3],
    /// u″ = −J⁻¹·H0, and u″ = −J⁻¹·(A·v″ + γ).
    pub accelerations: [&'a [Equation<'a>]; 2],
    /// The choices of inputs, that of the mechanism first. If there are more than 64, those that differ from it by one input.
    pub choices: &'a [DriverChoice<'a>],
    /// The links that turn.
    pub turning: &'a [Turning<'a>],
    /// The vectors of points, each once.
    pub vectors: &'a [ChainVector<'a>],
    /// The points that are written as sums of vectors.
    pub points: &'a [PointVectors<'a>],
    /// The conditions under which the simplified formulas hold.
    pub conditions: &'a [Formula<'a>],
}

/// A choice of inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DriverChoice<'a> {
    /// The inputs.
    pub inputs: &'a [Formula<'a>],
    /// The determinant of the columns of ∂Ψ/∂q of all other coordinates, in the order of the unknowns and inputs: the
    /// mechanism is singular where it is zero. None if it has no formula.
    pub determinant: Option<Equation<'a>>,
}

/// The skew matrices of a link that turns: Ω·r is the velocity and Ω²·r + α·r the acceleration of a point of it at r from
/// another one, relative to that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Turning<'a> {
    /// The coordinates in its angle, by name in the `linkage!` language.
    pub with: &'a [&'a str],
    /// Ω.
    pub rate: FormulaMatrix<'a>,
    /// α.
    pub acceleration: FormulaMatrix<'a>,
}

/// A point as a sum of vectors from the origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PointVectors<'a> {
    /// The name in the `linkage!` language.
    pub name: &'a str,
    /// Its vectors: indices of [`SheetDerivation::vectors`].
    pub vectors: &'a [usize],
    /// The position as the sum of vectors, the velocity as that of matrices times rates, the acceleration.
    pub sums: [Equation<'a>; 3],
}

/// A vector of length z at an angle φ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ChainVector<'a> {
    /// (z·cos φ, z·sin φ).
    pub vector: FormulaMatrix<'a>,
    /// (cos φ, −z·sin φ; sin φ, z·cos φ).
    pub matrix: FormulaMatrix<'a>,
    /// (z′, φ′): the matrix times them is the velocity.
    pub rates: FormulaMatrix<'a>,
    /// The derivative of the vector with respect to time.
    pub velocity: FormulaMatrix<'a>,
    /// Its second derivative.
    pub acceleration: FormulaMatrix<'a>,
}
