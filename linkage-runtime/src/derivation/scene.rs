//! The equations of motion of a scene as data.

use super::{Equation, Formula, Kernel, Symbol};

/// The equations of motion of a scene, from its bodies and effects: M(v)·v̈ = Q(v, v̇, t).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SceneDerivation<'a> {
    /// The name of the scene.
    pub scene: &'a str,
    /// The mechanism, or the driver of one.
    pub mechanism: &'a str,
    /// The parameters of its effects.
    pub parameters: &'a [Symbol<'a>],
    /// The mass matrix reduced to the inputs, M = Σ m·W_Gᵀ·W_G + j·wᵀ·w: its upper triangle, row by row; empty without
    /// inertia.
    pub mass_matrix: &'a [Equation<'a>],
    /// The generalised forces of the inputs, each the sum of the contributions of the bodies and effects, and of those of
    /// `frictions_and_stops`.
    pub forces: &'a [Effect<'a>],
    /// The frictions and stops, each of which adds to the generalised forces.
    pub frictions_and_stops: &'a [ContactEffect<'a>],
    /// The driven inputs as functions of time.
    pub drives: &'a [Equation<'a>],
    /// The potential energy of gravity, springs and potentials, if there are any.
    pub potential: Option<Equation<'a>>,
    /// The forces in the joints that `reaction` statements name.
    pub joints: &'a [JointForce<'a>],
    /// The Lagrange multipliers in the formulas of `joints`.
    pub multipliers: &'a [Formula<'a>],
    /// The forces of frictions and stops along their scalars, in the formulas of `joints`.
    pub contacts: &'a [Symbol<'a>],
    /// The emitted functions.
    pub kernels: &'a [Kernel<'a>],
}

/// The contribution of a body or an effect to the generalised forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Effect<'a> {
    /// The name in error messages: "spring on theta3".
    pub name: &'a str,
    /// The contribution to each Q, without those that are zero; for a body including the quadratic velocity terms.
    pub forces: &'a [Equation<'a>],
}

/// A friction or a stop: a force f along a scalar s(q), which its law determines from the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactEffect<'a> {
    /// The name in error messages: "friction on theta3".
    pub name: &'a str,
    /// Its force: f₁.
    pub force: Formula<'a>,
    /// The scalar along which it acts: s₁ = θ₃.
    pub along: Equation<'a>,
    /// The bound of its force if it is a friction, |f₁| ≤ μ·N; of its scalar if it is a stop, a ≤ s₁ ≤ b.
    pub bound: Formula<'a>,
    /// The joint whose force is in the bound.
    pub bearing: Option<Symbol<'a>>,
    /// The factor by which the rate of s changes at an impact on a stop: −e.
    pub rebound: Option<Formula<'a>>,
    /// The contribution to each Q, f₁·∂s₁/∂v, without those that are zero.
    pub forces: &'a [Equation<'a>],
}

/// The force of a joint on a link, in terms of the coordinates, rates and accelerations, of the Lagrange multipliers
/// lambda of the constraint equations in order, and of the forces of frictions and stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointForce<'a> {
    /// The joint and the link: "the pin at B on rod".
    pub name: &'a str,
    /// The components along x and y; for a guide the normal force and the moment.
    pub components: [Equation<'a>; 2],
}
