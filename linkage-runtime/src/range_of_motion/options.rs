//! The options of a range of motion.

use super::driven::Driven;
use crate::continuation::{AtChangePoint, Options};
use crate::scalar::to_f64;
use crate::{InputError, Mechanism, Name, PathErrorOf, Real};

/// The options of a range of motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RangeOptions<T = f64> {
    /// The options of its paths: the range of the input, none by default; the declared ranges of coordinates and outputs, at
    /// whose ends the motion ends by default; and the policy at change points, by default `Stop`: the motion ends there. `most_steps` is the largest number of steps in one direction, by default 20 000.
    pub path: Options<T>,
    /// A motion without end is given up where a coordinate is farther than this number of turns from its start, by
    /// default 60; for a length, a turn is 2 pi times the lengths of its loops.
    pub most_turns: u32,
}

/// Sixty turns of a pin in a slot that drives three wheels take 2900 steps.
const MOST_STEPS: usize = 20_000;

impl<T: Real> Default for RangeOptions<T> {
    fn default() -> Self {
        let at_change_point = AtChangePoint::Stop;
        Self { path: Options { at_change_point, most_steps: MOST_STEPS, ..Options::default() }, most_turns: 60 }
    }
}

impl<T: Real> RangeOptions<T> {
    /// The default options, but the motion passes change points smoothly.
    #[must_use]
    pub fn through_change_points() -> Self {
        let of = Self::default();
        Self { path: Options { at_change_point: AtChangePoint::Keep, ..of.path }, ..of }
    }
}

/// The options of a motion that ends at the ends of its parameter.
pub(super) fn within_parameter_range<M: Driven>(
    mechanism: &M,
    options: RangeOptions<M::Scalar>,
) -> Result<RangeOptions<M::Scalar>, PathErrorOf<M>> {
    let range = options.path.range.or(mechanism.parameter_range()?);
    Ok(RangeOptions { path: Options { range, ..options.path }, ..options })
}

/// The error of a number beyond the ends of a motion.
pub(super) fn out_of_range<M: Mechanism>(
    mechanism: &M,
    quantity: &'static str,
    value: M::Scalar,
    range: [M::Scalar; 2],
) -> PathErrorOf<M> {
    let ([least, most], value) = (range.map(to_f64), to_f64(value));
    let (of, quantity) = (Some(mechanism.name()), Name::from_static(quantity));
    InputError::OutOfRange { of, quantity, value, least, most }.into()
}
