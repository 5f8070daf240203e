//! Smallest and largest value of a quantity over a range of the input, at the zeros of its derivative.
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

use crate::jacobian::root;
use crate::{OutputMotion, PositionError, Real, real};

/// The steps in which a turn or a range is searched.
const STEPS: u32 = 360;

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
/// `quantity` returns a value with its first and second derivative by the input. The range is searched in 360 steps; in
/// each, up to two zeros of the derivative are found, to an ulp of the input. The value there is as accurate as
/// `quantity` itself. With more extremes in a step some are missed.
///
/// # Errors
/// Those of `quantity`.
pub fn over_range<T: Real>(
    [from, to]: [T; 2],
    mut quantity: impl FnMut(T) -> Result<OutputMotion<T>, PositionError>,
) -> Result<Extremes<T>, PositionError> {
    let first = quantity(from)?;
    let start = Extreme { input: from, value: first.value };
    let mut found = Extremes { least: start, largest: start };
    let mut last = (from, first);
    for step in 1..=STEPS {
        let part: T = real(f64::from(step) / f64::from(STEPS));
        let input = if step == STEPS { to } else { from + (to - from) * part };
        let here = (input, quantity(input)?);
        found.include(input, here.1.value);
        if has_opposite_signs(last.1.velocity, here.1.velocity) {
            found.zero_between(last, here, &mut quantity)?;
        } else if has_opposite_signs(last.1.velocity, last.1.acceleration)
            && has_opposite_signs(last.1.acceleration, here.1.acceleration)
        {
            // The derivative comes nearer to zero and leaves again: between, it may have two zeros.
            let ends = [last.1.acceleration, here.1.acceleration];
            let nearest = root([last.0, input], ends, ulp(last.0, input), |input| {
                quantity(input).map(|at| Some(at.acceleration))
            })?;
            if let Some(nearest) = nearest {
                let middle = (nearest, quantity(nearest)?);
                if has_opposite_signs(last.1.velocity, middle.1.velocity) {
                    found.zero_between(last, middle, &mut quantity)?;
                    found.zero_between(middle, here, &mut quantity)?;
                }
            }
        }
        last = here;
    }
    Ok(found)
}

fn has_opposite_signs<T: Real>(one: T, other: T) -> bool {
    (one < T::zero() && other > T::zero()) || (one > T::zero() && other < T::zero())
}

/// An ulp of the larger of two numbers.
fn ulp<T: Real>(one: T, other: T) -> T {
    one.abs().max(other.abs()) * T::default_epsilon()
}

impl<T: Real> Extremes<T> {
    fn include(&mut self, input: T, value: T) {
        if value < self.least.value {
            self.least = Extreme { input, value };
        }
        if value > self.largest.value {
            self.largest = Extreme { input, value };
        }
    }

    /// Includes the zero of the derivative between two inputs.
    fn zero_between(
        &mut self,
        (low, at_low): (T, OutputMotion<T>),
        (high, at_high): (T, OutputMotion<T>),
        mut quantity: impl FnMut(T) -> Result<OutputMotion<T>, PositionError>,
    ) -> Result<(), PositionError> {
        let mut slope = |input: T| quantity(input).map(|at| Some(at.velocity));
        let zero = root([low, high], [at_low.velocity, at_high.velocity], ulp(low, high), &mut slope)?;
        if let Some(input) = zero {
            let value = quantity(input)?.value;
            self.include(input, value);
        }
        Ok(())
    }
}
