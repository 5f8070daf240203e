//! How a path is followed.

use crate::{Error, Real, real};

/// The policy at a change point, where motions of the mechanism cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtChangePoint {
    /// The motion goes on smoothly: a parallelogram stays a parallelogram.
    #[default]
    Keep,
    /// The other motion is taken, the way in which the input keeps its direction, or where it rests the first of the
    /// unknowns that move. Where more than two motions cross, there is not one other: the path ends as by `Stop`.
    Switch,
    /// The path ends there; [`choose`](super::Path::choose) says how it goes on.
    Stop,
}

/// Where the path goes from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction<Q> {
    /// The input grows.
    Increasing,
    /// The input falls.
    Decreasing,
    /// Along these rates of the coordinates, as far as the mechanism can follow: what is left to say at a dead point
    /// and at a change point.
    Along(Q),
}

/// How a path is followed. Distances are pure numbers: those of angles are radians, and lengths count beside the
/// lengths of the loops that they stand in. There are no tolerances: positions and events are found to rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T = f64> {
    /// The longest step, by default 1/4.
    pub longest_step: T,
    /// The most that the tangent turns in one step, in radians, by default 1/4. Steps shrink where the path turns
    /// sharply, down to rounding.
    pub largest_turn: T,
    /// The most steps that one call takes, by default a million.
    pub most_steps: usize,
    /// What is done where two motions cross.
    pub at_change_point: AtChangePoint,
    /// The range of the input, at the ends of which the path stops.
    pub range: Option<[T; 2]>,
}

impl<T: Real> Default for Options<T> {
    fn default() -> Self {
        Self {
            longest_step: real(0.25),
            largest_turn: real(0.25),
            most_steps: 1_000_000,
            at_change_point: AtChangePoint::Keep,
            range: None,
        }
    }
}

/// A step of less than this many roundings is rounding itself.
const ROUNDINGS: f64 = 1024.0;

impl<T: Real> Options<T> {
    /// # Errors
    /// [`Error::Invalid`] where an option makes no sense.
    pub(super) fn check(&self, mechanism: &'static str, input: T) -> Result<(), Error> {
        let least = real::<T>(ROUNDINGS) * T::default_epsilon();
        let is_fraction = |value: T| value >= least && value <= T::one();
        let quantity = if !is_fraction(self.longest_step) {
            "the longest step, a number from rounding to 1"
        } else if !is_fraction(self.largest_turn) {
            "the largest turn, a number from rounding to 1"
        } else if self.most_steps == 0 {
            "the most steps, of which there must be one"
        } else if self.range.is_some_and(|[low, high]| !(low < high && low <= input && input <= high)) {
            "the range of the input, in which the start must lie"
        } else {
            return Ok(());
        };
        Err(Error::Invalid { mechanism, quantity })
    }
}
