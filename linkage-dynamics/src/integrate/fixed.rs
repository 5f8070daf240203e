//! Steps of fixed length for real time.

use super::control::{positive, within};
use super::integration::finite;
use super::system::{ErrorOf, IntoSystem, StateOf, System};
use super::tableau::{self, SLOPES, Stage, Weights};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{Build, Column, D, real};

/// Kutta's method of order 4 (Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993),
/// table 1.2 of section II.1).
pub const STAGES: &[Stage] = &[
    Stage { node: 0.5, weights: &[(0, 0.5)] },
    Stage { node: 0.5, weights: &[(1, 0.5)] },
    Stage { node: 1.0, weights: &[(2, 1.0)] },
];

/// y1 = y + h (k0 + 2 k1 + 2 k2 + k3) / 6.
pub const SOLUTION: Weights = &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)];

/// An integration by steps of fixed length, without error control: each step takes exactly four evaluations of the
/// rate. It has no events.
///
/// The choice of the method: explicit symplectic methods require a constant mass matrix and forces without velocities,
/// which mechanisms do not have. Kutta's method is of order 4, and unlike explicit methods of order 1 and 2 it is
/// stable for undamped oscillations, up to a step of 2.8 / angular frequency.
#[derive(Debug, Clone)]
pub struct FixedStep<S: System> {
    system: S,
    start: S::Scalar,
    length: S::Scalar,
    steps: u64,
    state: StateOf<S>,
}

impl<S: System<Events = D<0>, Guards = D<0>>> FixedStep<S> {
    /// Starts from state `y` at `start` with steps of this length, negative for steps back in time.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`](linkage_runtime::InputError::OutOfRange) if the length is zero or not finite, or `start` is not, [`MotionError::NotFinite`](crate::MotionError::NotFinite) if the state is not.
    pub fn new<B>(
        system: impl IntoSystem<B, System = S>,
        (start, y): (S::Scalar, impl Into<StateOf<S>>),
        length: S::Scalar,
    ) -> Result<Self, ErrorOf<S>> {
        let y = y.into();
        within("the time", to_f64(start), f64::MIN, f64::MAX)?;
        positive("the step", to_f64(length.abs()))?;
        finite("the initial state", start, &y)?;
        Ok(Self { system: system.into_system(), start, length, steps: 0, state: y })
    }

    /// The time start + n h after n steps: rounding errors do not accumulate.
    #[must_use]
    pub fn t(&self) -> S::Scalar {
        self.start + real::<S::Scalar>(self.steps as f64) * self.length
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &StateOf<S> {
        &self.state
    }

    /// The system in its current state.
    #[must_use]
    pub fn system(&self) -> &S {
        &self.system
    }

    /// Undoes the last step; `state` is the state before it.
    pub(crate) fn undo(&mut self, state: StateOf<S>) {
        self.steps -= 1;
        self.state = state;
    }

    /// Takes a step.
    ///
    /// # Errors
    /// Those of the system, and [`MotionError::NotFinite`](crate::MotionError::NotFinite); time and state then stay unchanged.
    pub fn step(&mut self) -> Result<(), ErrorOf<S>> {
        let (t, h) = (self.t(), self.length);
        let y = self.system.before_step(t, &self.state)?.unwrap_or(self.state);
        let mut slopes = [y.dim().zeros(); SLOPES];
        slopes[0] = self.system.rate(t, &y)?;
        tableau::evaluate(|t, y| self.system.rate(t, y), STAGES, 1, (t, &y), h, &mut slopes)?;
        let next = y + tableau::combination(&slopes, SOLUTION) * h;
        finite("the rate or the state", t, &next)?;
        finite("the time", t, &Column::from([t + h]))?;
        self.state = next;
        self.steps += 1;
        Ok(())
    }
}
