//! The equations of motion of a scene as data.

use super::{Equation, Kernel, Symbol};

/// How the motion of a scene follows from its bodies and effects: M(v)·v̈ = Q(v, v̇, t).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneDerivation {
    /// Its name.
    pub scene: &'static str,
    /// The mechanism, or the driver of one.
    pub mechanism: &'static str,
    /// The parameters of its effects.
    pub parameters: &'static [Symbol],
    /// The mass matrix reduced to the inputs, M = Σ m·W_Gᵀ·W_G + j·wᵀ·w, row by row from the diagonal on; empty
    /// without inertia.
    pub mass_matrix: &'static [Equation],
    /// The generalised forces of the inputs, which are the sum of what each body and each effect adds.
    pub forces: &'static [Effect],
    /// The potential energy of gravity, springs and potentials, if it has any.
    pub potential: Option<Equation>,
    /// The emitted functions.
    pub kernels: &'static [Kernel],
}

/// What a body or an effect adds to the generalised forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effect {
    /// What errors call it: "spring on theta3".
    pub name: &'static str,
    /// Its share of each Q, but for those that are zero; of a body with the quadratic velocity terms.
    pub forces: &'static [Equation],
}
