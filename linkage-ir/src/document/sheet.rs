//! The formulas of an analysis by hand.

use super::{Equation, Formula, FormulaMatrix, List, Storage, Text};

records! {
    /// The formulas of an analysis by hand, line by line, of a mechanism with `derive sheet`. With Ψ′ = J·u′ + A·v′, the second
    /// derivative is Ψ″ = J·u″ + A·v″ + J′·u′ + A′·v′.
    SheetDerivation {
        /// The mechanism, or the driver of one.
        mechanism: Text<'a, S>,
        /// J′ and A′, the derivatives of J and A with respect to time.
        jacobian_rates: [FormulaMatrix<'a, S>; 2],
        /// ∂(J·u′)/∂u and ∂(A·v′)/∂v: they are J′ and A′ if J does not depend on v, nor A on u.
        jacobians_of_rates: [FormulaMatrix<'a, S>; 2],
        /// H1 = A·v″, H2 = J′·(W·v′), H3 = A′·v′, and their sum H0.
        terms: [FormulaMatrix<'a, S>; 4],
        /// The parts of γ: quadratic in u′, quadratic in v′, and bilinear in both.
        gamma: [FormulaMatrix<'a, S>; 3],
        /// u″ = −J⁻¹·H0, and u″ = −J⁻¹·(A·v″ + γ).
        accelerations: [List<'a, S, Equation<Formula<'a, S>>>; 2],
        /// The choices of inputs, that of the mechanism first. If there are more than 64, those that differ from it by one input.
        choices: List<'a, S, DriverChoice<'a, S>>,
        /// The links that turn.
        turning: List<'a, S, Turning<'a, S>>,
        /// The vectors of points, each once.
        vectors: List<'a, S, ChainVector<'a, S>>,
        /// The points that are written as sums of vectors.
        points: List<'a, S, PointVectors<'a, S>>,
        /// The conditions under which the simplified formulas hold.
        conditions: List<'a, S, Formula<'a, S>>,
    }

    /// A choice of inputs.
    DriverChoice {
        /// The inputs.
        inputs: List<'a, S, Formula<'a, S>>,
        /// The determinant of the columns of ∂Ψ/∂q of all other coordinates, in the order of the unknowns and inputs: the
        /// mechanism is singular where it is zero. None if it has no formula.
        determinant: Option<Equation<Formula<'a, S>>>,
    }

    /// The skew matrices of a link that turns: Ω·r is the velocity and Ω²·r + α·r the acceleration of a point of it at r from
    /// another one, relative to that.
    Turning {
        /// The coordinates in its angle, by name in the `linkage!` language.
        with: List<'a, S, Text<'a, S>>,
        /// Ω.
        rate: FormulaMatrix<'a, S>,
        /// α.
        acceleration: FormulaMatrix<'a, S>,
    }

    /// A point as a sum of vectors from the origin.
    PointVectors {
        /// The name in the `linkage!` language.
        name: Text<'a, S>,
        /// Its vectors: indices of [`SheetDerivation::vectors`].
        vectors: List<'a, S, usize>,
        /// The position as the sum of vectors, the velocity as that of matrices times rates, the acceleration.
        sums: [Equation<Formula<'a, S>>; 3],
    }

    /// A vector of length z at an angle φ.
    ChainVector {
        /// (z·cos φ, z·sin φ).
        vector: FormulaMatrix<'a, S>,
        /// (cos φ, −z·sin φ; sin φ, z·cos φ).
        matrix: FormulaMatrix<'a, S>,
        /// (z′, φ′): the matrix times them is the velocity.
        rates: FormulaMatrix<'a, S>,
        /// The derivative of the vector with respect to time.
        velocity: FormulaMatrix<'a, S>,
        /// Its second derivative.
        acceleration: FormulaMatrix<'a, S>,
    }
}
