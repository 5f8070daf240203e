//! The options of circuits.

use crate::Real;
use crate::continuation::Options;

/// The options of circuits.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CircuitOptions<T = f64> {
    /// The options of the paths. `most_steps` is the largest number of steps of one motion in one direction, by default
    /// 20 000. The policy
    /// at change points, `Keep` or `Switch`, says which halves of the motions that cross there make one motion; with
    /// `Stop` a change point is an error.
    pub path: Options<T>,
    /// A motion is not closed if a coordinate is farther than this number of turns from its start, by default 60; for a
    /// length, a turn is 2 pi times the lengths of its loops. A rack that goes on turn by turn never closes.
    pub most_turns: u32,
}

/// Sixty turns of a pin in a slot that drives three wheels take 2900 steps.
const MOST_STEPS: usize = 20_000;

impl<T: Real> Default for CircuitOptions<T> {
    fn default() -> Self {
        Self { path: Options { most_steps: MOST_STEPS, ..Options::default() }, most_turns: 60 }
    }
}
