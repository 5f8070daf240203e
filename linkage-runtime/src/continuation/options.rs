//! Options of path following.

use crate::jacobian::ulp::{EQUAL_ULPS, ulps};
use crate::scalar::to_f64;
use crate::{InputError, Name, Real, real};

/// The policy at a change point, where motions of the mechanism cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AtChangePoint {
    /// The path continues smoothly: a parallelogram stays a parallelogram.
    #[default]
    Keep,
    /// The path continues on the other motion, in the direction in which the rate of the input keeps its sign, or if
    /// the input rests, that of the first unknown that moves. If more than two motions cross, the path ends as with
    /// `Stop`.
    Switch,
    /// The path ends; [`choose`](super::Path::choose) selects the motion on which it continues.
    Stop,
}

/// The initial direction of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction<R> {
    /// The input increases.
    Increasing,
    /// The input decreases.
    Decreasing,
    /// The direction along the path nearest to these rates of the coordinates. It is needed at dead points and change
    /// points, where the sign of the input's rate determines no direction.
    Along(R),
}

/// The options of path following. Distances are nondimensional: angles in radians, lengths divided by the lengths of
/// their loops. There are no tolerances: positions and events are accurate to rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options<T = f64> {
    /// The longest step, by default 1/4.
    pub longest_step: T,
    /// The largest turn of the tangent in one step, in radians, by default 1/4. Steps shrink at sharp bends, down to
    /// rounding error.
    pub largest_turn: T,
    /// The largest number of steps of one call of [`advance_to`](super::Path::advance_to), by default a million.
    pub most_steps: usize,
    /// The policy at change points.
    pub at_change_point: AtChangePoint,
    /// The range of the input; the path ends at its limits.
    pub range: Option<[T; 2]>,
    /// True if the path ends where a coordinate or an output is at an end of the range that the mechanism declares for it,
    /// and must start within these ranges; by default true.
    pub joint_ranges: bool,
}

impl<T: Real> Default for Options<T> {
    fn default() -> Self {
        Self {
            longest_step: real(0.25),
            largest_turn: real(0.25),
            most_steps: 1_000_000,
            at_change_point: AtChangePoint::Keep,
            range: None,
            joint_ranges: true,
        }
    }
}

/// The least `longest_step` and `largest_turn`, in ulps. It leaves room for six halvings of a step before
/// [`EQUAL_ULPS`], at which a path gives up.
const LEAST_STEP_ULPS: f64 = 64.0 * EQUAL_ULPS;

impl<T: Real> Options<T> {
    /// # Errors
    /// [`InputError::OutOfRange`] for an invalid option.
    pub(super) fn check<N: Name>(&self, mechanism: N, input: T) -> Result<(), InputError<N>> {
        let within = |quantity: &'static str, value: f64, least: f64, most: f64| {
            let is_within = value >= least && value <= most;
            let (of, quantity) = (Some(mechanism.clone()), N::from_static(quantity));
            if is_within { Ok(()) } else { Err(InputError::OutOfRange { of, quantity, value, least, most }) }
        };
        let least = to_f64(ulps::<T>(LEAST_STEP_ULPS));
        within("the longest step", to_f64(self.longest_step), least, 1.0)?;
        within("the largest turn", to_f64(self.largest_turn), least, 1.0)?;
        within("the number of steps", self.most_steps as f64, 1.0, f64::INFINITY)?;
        if let Some([low, high]) = self.range {
            let is_range = low < high;
            let [least, most] = [low, high].map(to_f64);
            if !is_range {
                let (value, least) = (least, f64::NEG_INFINITY);
                let (of, quantity) = (Some(mechanism), N::from_static("the least input"));
                return Err(InputError::OutOfRange { of, quantity, value, least, most });
            }
            within("the input at the start", to_f64(input), least, most)?;
        }
        Ok(())
    }
}
