//! Errors for motions that end at a singularity.

use super::independent::Independent;
use super::motion::Motion;
use crate::{Coordinates, MotionError, Scene};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::jacobian::Blocks;
use linkage_runtime::jacobian::ulp::nearly_zero;
use linkage_runtime::{Column, Mechanism, PathError, PositionError};

impl<S: Scene, W> Motion<'_, S, W> {
    /// The change-point error with the group of least regularity.
    pub(super) fn change_point_error(&self, q: &Coordinates<S>) -> MotionError {
        let mechanism = self.scene.mechanism();
        let (_, group) = Blocks::of(mechanism, &mechanism.pose_at(q)).least_regular();
        PathError::ChangePoint { mechanism: S::Mechanism::NAME, group }.into()
    }

    /// The error if no choice of coordinates is regular: a prescribed input is at a dead point, or two motions cross.
    pub(super) fn no_coordinates_error(&self, t: S::Scalar, q: &Coordinates<S>) -> MotionError {
        let mechanism = self.scene.mechanism();
        let is_driven = self.prescribed_inputs(t).iter().any(|&held| held);
        let freely = Independent::choose(mechanism, &mechanism.pose_at(q), &self.scales, &Column::repeat(false));
        let is_regular = freely.regularity() > nearly_zero();
        if is_driven && is_regular { self.singular_error(q) } else { self.change_point_error(q) }
    }

    pub(super) fn singular_error(&self, q: &Coordinates<S>) -> MotionError {
        let mechanism = self.scene.mechanism();
        let (regularity, group) = Blocks::of(mechanism, &mechanism.pose_at(q)).least_regular();
        let regularity = to_f64(regularity);
        PositionError::Singular { mechanism: S::Mechanism::NAME, group, regularity }.into()
    }
}
