//! Positions with all that is computed from their coordinates.

use linkage_runtime::{Bounded, Dim};

use super::{CoordinatesAtRunTime, MOST_OF_POSE};

/// A position of a mechanism at run time: the numbers of the pose of emitted code in order, and the coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseAtRunTime<V: Dim> {
    pub(crate) numbers: Bounded<f64, MOST_OF_POSE>,
    /// An angle that the pose stores as a direction is between -pi and pi.
    pub(crate) coordinates: CoordinatesAtRunTime<V>,
}
