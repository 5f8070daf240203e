//! Smallest and largest value of a quantity over a range of the input, at the zeros of its derivative.
//!
//! [`over_turn`] and [`over_range`] take any quantity at an input, such as an output on a branch, and do not notice where it
//! jumps to another motion. `over`, with `std`, follows one motion from end to end.
//!
//! ```
//! # linkage::linkage! {
//! #     pub mechanism FourBar {
//! #         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
//! #         input theta2;
//! #         unknown theta3, theta4;
//! #         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
//! #         output mu = theta3 - theta4;
//! #     }
//! # }
//! use linkage::extremes::over_turn;
//!
//! let (four_bar, branch) = (FourBar::default(), FourBarBranch::new(linkage::Elbow::Left));
//! // The derivatives by the input: its rate is 1, its acceleration 0.
//! let mu = over_turn(|theta2| Ok(four_bar.full_kinematics(theta2, branch, 1.0, 0.0)?.outputs.mu))?;
//! // The transmission angle is least and largest where the crank is in line with the frame.
//! let inputs = [mu.least.input, mu.largest.input];
//! assert!(inputs.iter().any(|input| (input - std::f64::consts::PI).abs() < 1e-12));
//! # Ok::<(), linkage::Error>(())
//! ```

#[cfg(feature = "std")]
mod along;
#[cfg(feature = "std")]
mod at_input;
#[cfg(feature = "std")]
mod constant;
#[cfg(feature = "std")]
mod course;
#[cfg(feature = "std")]
mod on_turns;
#[cfg(feature = "std")]
mod piece;
#[cfg(feature = "std")]
mod rests;

#[cfg(feature = "std")]
pub use along::{courses, courses_on_turns, over};
#[cfg(feature = "std")]
pub use course::Course;

use crate::jacobian::{Sample, first_zero, root};
use crate::{OutputMotion, PositionError, Real, real};

/// The steps in which a turn or a range is searched.
const STEPS: u32 = 360;

/// The most zeros of the derivative in a step.
const MOST_IN_A_STEP: usize = 16;

/// A value, and the input at which it is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extreme<T = f64> {
    /// The input.
    pub input: T,
    /// The value there.
    pub value: T,
}

/// The smallest and the largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extremes<T = f64> {
    /// The smallest value.
    pub least: Extreme<T>,
    /// The largest value.
    pub largest: Extreme<T>,
}

/// The extremes over a turn of the input, from 0 to 2 pi; see [`over_range`].
///
/// # Errors
/// Those of `quantity`.
pub fn over_turn<T: Real>(
    quantity: impl FnMut(T) -> Result<OutputMotion<T>, PositionError>,
) -> Result<Extremes<T>, PositionError> {
    over_range([T::zero(), T::two_pi()], quantity)
}

/// The extremes over a range of the input, ends included.
///
/// `quantity` returns a value with its first and second derivative by the input. The range is searched in 360 steps, in
/// each the zeros of the derivative are found from its values and slopes: none is missed of a derivative that
/// deviates from its cubic in a step by less than a few times what the cubic deviates from its chord. Each is found to an
/// ulp of the input; the value there is as accurate as `quantity` itself. Of a quantity that turns many times in a step
/// some extremes are missed, and next to kinks and jumps.
///
/// # Errors
/// Those of `quantity`.
pub fn over_range<T: Real>(
    [from, to]: [T; 2],
    mut quantity: impl FnMut(T) -> Result<OutputMotion<T>, PositionError>,
) -> Result<Extremes<T>, PositionError> {
    let first = quantity(from)?;
    let mut found = Extremes::only(from, first.value);
    let mut last = slope_at(from, &first);
    for step in 1..=STEPS {
        let part: T = real(f64::from(step) / f64::from(STEPS));
        let input = if step == STEPS { to } else { from + (to - from) * part };
        let here = quantity(input)?;
        found.include(input, here.value);
        let end = slope_at(input, &here);
        for _ in 0..MOST_IN_A_STEP {
            let enough = ulp(last.at, input);
            let around = first_zero([last, end], enough, |at| quantity(at).map(|motion| slope_at(at, &motion)))?;
            let Some([low, high]) = around else { break };
            let (ends, values) = ([low.at, high.at], [low.value, high.value]);
            let zero = root(ends, values, enough, |at| quantity(at).map(|motion| Some(motion.rate)))?;
            let at = zero.unwrap_or(high.at);
            let there = quantity(at)?;
            found.include(at, there.value);
            last = Sample { value: T::zero(), ..slope_at(at, &there) };
        }
        last = end;
    }
    Ok(found)
}

/// The derivative of a quantity with its own.
fn slope_at<T: Real>(at: T, motion: &OutputMotion<T>) -> Sample<T> {
    Sample { at, value: motion.rate, slope: motion.acceleration }
}

/// An ulp of the larger of two numbers.
fn ulp<T: Real>(one: T, other: T) -> T {
    one.abs().max(other.abs()) * T::default_epsilon()
}

impl<T: Real> Extremes<T> {
    fn only(input: T, value: T) -> Self {
        let only = Extreme { input, value };
        Self { least: only, largest: only }
    }

    fn include(&mut self, input: T, value: T) {
        if value < self.least.value {
            self.least = Extreme { input, value };
        }
        if value > self.largest.value {
            self.largest = Extreme { input, value };
        }
    }
}
