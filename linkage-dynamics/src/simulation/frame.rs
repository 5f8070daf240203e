//! The tangent space of a motion at a position.

use super::motion::{Change, Choice, FactorsOf, Motion};
use crate::{Coordinates, Scene};
use linkage_runtime::{Matrix, Mechanism, PerInput};

/// A basis of the rates.
pub(super) type Basis<S> = (
    Matrix<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>,
    Matrix<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::V>,
);

/// The rates q' = N z' and accelerations q'' = N z'' + b at a position, in independent coordinates z.
pub(super) struct Frame<S: Scene> {
    /// The position, on the constraints to rounding error if it is interpolated.
    pub(super) q: Coordinates<S>,
    /// The rows of N of the unknowns and of the inputs.
    pub(super) basis: Basis<S>,
    /// b.
    pub(super) bias: Change<S>,
    /// True if it is interpolated, next to a change point.
    pub(super) is_interpolated: bool,
}

impl<S: Scene> Frame<S> {
    /// q' from z'.
    pub(super) fn rates(&self, free: &PerInput<S::Mechanism>) -> Change<S> {
        let (unknowns, inputs) = &self.basis;
        Change::<S> { unknowns: *unknowns * *free, inputs: *inputs * *free }
    }

    /// q'' from z''.
    pub(super) fn accelerations(&self, free: &PerInput<S::Mechanism>) -> Change<S> {
        self.rates(free) + self.bias
    }
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// The frame by the factors of [J A] at `q`.
    pub(super) fn exact_frame(
        &self,
        factors: &FactorsOf<S>,
        q: &Coordinates<S>,
        rates: &PerInput<S::Mechanism>,
    ) -> Frame<S> {
        let (basis, bias) = (factors.basis(), self.bias(factors, q, rates));
        Frame { q: *q, basis, bias, is_interpolated: false }
    }

    /// The q'' at z'' = 0.
    pub(super) fn bias(&self, factors: &FactorsOf<S>, q: &Coordinates<S>, rates: &PerInput<S::Mechanism>) -> Change<S> {
        let mechanism = self.scene.mechanism();
        let velocity = factors.rates(rates);
        let rates = S::Mechanism::rates(velocity.unknowns, velocity.inputs);
        -factors.solve(&mechanism.gamma(&mechanism.pose_at(q), &rates))
    }

    /// The factors of [J A] at a position, in the order of a choice.
    pub(super) fn factors(&self, independent: &Choice<S>, q: &Coordinates<S>) -> FactorsOf<S> {
        let mechanism = self.scene.mechanism();
        independent.factors(mechanism, &mechanism.pose_at(q), &self.scales)
    }
}
