//! The mechanism that a search evaluates, and its outcome at an input.

use super::Limit;
use crate::scalar::arithmetic::*;
use crate::{Column, Mechanism, PositionError};

/// The position at the inputs of a position nearby.
type Assemble<'m, M> =
    &'m dyn Fn(&<M as Mechanism>::Coordinates) -> Result<<M as Mechanism>::Pose, PositionError<<M as Mechanism>::Name>>;

/// A limit of an input of a mechanism.
pub(super) type LimitOf<M> = Limit<<M as Mechanism>::Scalar, <M as Mechanism>::Name>;

/// A mechanism whose limits of one input are searched.
pub(super) struct Searched<'m, M: Mechanism> {
    pub(super) mechanism: &'m M,
    /// The place of the input among the inputs.
    pub(super) place: usize,
    /// The range of the input that is searched on either side.
    pub(super) reach: M::Scalar,
    pub(super) assemble: Assemble<'m, M>,
    pub(super) coordinates: &'m dyn Fn(&M::Pose) -> M::Coordinates,
}

/// The outcome at an input.
pub(super) enum Found<M: Mechanism> {
    /// A position.
    Assembled(Sample<M>),
    /// A group is undetermined here: the search skips the input.
    Undetermined,
    /// A group has no position: its unknowns.
    Stopped(M::Name),
}

/// A position evaluated by the search, with the magnitudes of the determinants of its groups.
pub(super) struct Sample<M: Mechanism> {
    pub(super) input: M::Scalar,
    pub(super) position: M::Coordinates,
    pub(super) determinants: Column<M::Scalar, M::G>,
}

impl<M: Mechanism> Clone for Sample<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism> Copy for Sample<M> {}

impl<M: Mechanism> Sample<M> {
    /// The determinant of a group; zero for an invalid index.
    pub(super) fn determinant(&self, place: usize) -> M::Scalar {
        self.determinants.as_slice().get(place).copied().unwrap_or_else(M::Scalar::zero)
    }
}
