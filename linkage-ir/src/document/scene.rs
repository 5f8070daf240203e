//! The equations of motion of a scene.

use super::{Equation, Formula, Kernel, List, Storage, Symbol, Text};

records! {
    /// The equations of motion of a scene, from its bodies and effects: M(v)·v̈ = Q(v, v̇, t).
    SceneDerivation {
        /// The name of the scene.
        scene: Text<'a, S>,
        /// The mechanism, or the driver of one.
        mechanism: Text<'a, S>,
        /// The parameters of its effects.
        parameters: List<'a, S, Symbol<'a, S>>,
        /// The mass matrix reduced to the inputs, M = Σ m·W_Gᵀ·W_G + j·wᵀ·w: its upper triangle, row by row; empty without
        /// inertia.
        mass_matrix: List<'a, S, Equation<Formula<'a, S>>>,
        /// The generalised forces of the inputs, each the sum of the contributions of the bodies and effects, and of those of
        /// `frictions_and_stops`.
        forces: List<'a, S, Effect<'a, S>>,
        /// The frictions and stops, each of which adds to the generalised forces.
        frictions_and_stops: List<'a, S, ContactEffect<'a, S>>,
        /// The driven inputs as functions of time.
        drives: List<'a, S, Equation<Formula<'a, S>>>,
        /// The potential energy of gravity, springs and potentials, if there are any.
        potential: Option<Equation<Formula<'a, S>>>,
        /// The forces in the joints that `reaction` statements name.
        joints: List<'a, S, JointForce<'a, S>>,
        /// The Lagrange multipliers in the formulas of `joints`.
        multipliers: List<'a, S, Formula<'a, S>>,
        /// The forces of frictions and stops along their scalars, in the formulas of `joints`.
        contacts: List<'a, S, Symbol<'a, S>>,
        /// The emitted functions.
        kernels: List<'a, S, Kernel<'a, S>>,
    }

    /// The contribution of a body or an effect to the generalised forces.
    Effect {
        /// The name in error messages: "spring on theta3".
        name: Text<'a, S>,
        /// The contribution to each Q, without those that are zero; for a body including the quadratic velocity terms.
        forces: List<'a, S, Equation<Formula<'a, S>>>,
    }

    /// A friction or a stop: a force f along a scalar s(q), which its law determines from the motion.
    ContactEffect {
        /// The name in error messages: "friction on theta3".
        name: Text<'a, S>,
        /// Its force: f₁.
        force: Formula<'a, S>,
        /// The scalar along which it acts: s₁ = θ₃.
        along: Equation<Formula<'a, S>>,
        /// The bound of its force if it is a friction, |f₁| ≤ μ·N; of its scalar if it is a stop, a ≤ s₁ ≤ b.
        bound: Formula<'a, S>,
        /// The joint whose force is in the bound.
        bearing: Option<Symbol<'a, S>>,
        /// The factor by which the rate of s changes at an impact on a stop: −e.
        rebound: Option<Formula<'a, S>>,
        /// The contribution to each Q, f₁·∂s₁/∂v, without those that are zero.
        forces: List<'a, S, Equation<Formula<'a, S>>>,
    }

    /// The force of a joint on a link, in terms of the coordinates, rates and accelerations, of the Lagrange multipliers
    /// lambda of the constraint equations in order, and of the forces of frictions and stops.
    JointForce {
        /// The joint and the link: "the pin at B on rod".
        name: Text<'a, S>,
        /// The components along x and y; for a guide the normal force and the moment.
        components: [Equation<Formula<'a, S>>; 2],
    }
}
