//! How a path is followed.

use crate::jacobian::rounding::{SAME, roundings};
use crate::scalar::to_f64;
use crate::{InputError, Real, real};

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
pub enum Direction<R> {
    /// The input grows.
    Increasing,
    /// The input falls.
    Decreasing,
    /// Along these rates of the coordinates, as far as the mechanism can follow: what is left to say at a dead point
    /// and at a change point.
    Along(R),
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

/// The shortest longest step and turn, in roundings: six halvings of it are still more than rounding.
const LEAST: f64 = 64.0 * SAME;

impl<T: Real> Options<T> {
    /// # Errors
    /// [`InputError::OutOfRange`] where an option makes no sense.
    pub(super) fn check(&self, mechanism: &'static str, input: T) -> Result<(), InputError> {
        let within = |quantity: &'static str, value: f64, least: f64, most: f64| {
            let is_within = value >= least && value <= most;
            is_within.then_some(()).ok_or(InputError::OutOfRange { of: Some(mechanism), quantity, value, least, most })
        };
        let least = to_f64(roundings::<T>(LEAST));
        within("the longest step", to_f64(self.longest_step), least, 1.0)?;
        within("the largest turn", to_f64(self.largest_turn), least, 1.0)?;
        within("the number of steps", self.most_steps as f64, 1.0, f64::INFINITY)?;
        if let Some([low, high]) = self.range {
            let is_range = low < high;
            let [least, most] = [low, high].map(to_f64);
            if !is_range {
                let (value, least) = (least, f64::NEG_INFINITY);
                let of = Some(mechanism);
                return Err(InputError::OutOfRange { of, quantity: "the least input", value, least, most });
            }
            within("the input at the start", to_f64(input), least, most)?;
        }
        Ok(())
    }
}
