//! Positions with all that is computed from their coordinates.

use linkage_runtime::{Bounded, Dim};

use super::{CoordinatesAtRunTime, MOST_OF_POSE};

/// A position of a mechanism at run time: the numbers of the pose of emitted code in order, and the coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseAtRunTime<V: Dim> {
    pub(crate) numbers: Bounded<f64, MOST_OF_POSE>,
    /// Those that the pose was made of, or of a pose that a function found those that it holds: an angle that it has as a
    /// direction alone is then between -pi and pi, and its turns change nothing.
    pub(crate) coordinates: CoordinatesAtRunTime<V>,
}
