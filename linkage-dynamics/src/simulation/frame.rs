//! The tangent space of a motion at a position.

use crate::{Coordinates, Scene};
use linkage_runtime::jacobian::VectorOf;
use linkage_runtime::{Matrix, PerInput};

/// Changes, rates or accelerations of u and v.
pub(super) type Change<S> = VectorOf<<S as Scene>::Mechanism>;

/// A basis of the rates.
pub(super) type Basis<S> = (
    Matrix<<S as Scene>::Scalar, <S as Scene>::U, <S as Scene>::V>,
    Matrix<<S as Scene>::Scalar, <S as Scene>::V, <S as Scene>::V>,
);

/// The rates `q' = N z'` and accelerations `q'' = N z'' + b` at a position, in independent coordinates z.
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

    /// `q''` from `z''`.
    pub(super) fn accelerations(&self, free: &PerInput<S::Mechanism>) -> Change<S> {
        self.rates(free) + self.bias
    }
}
