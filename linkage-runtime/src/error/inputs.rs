//! The inputs in a message.

use core::fmt::{self, Debug, Display, Formatter};

use crate::scalar::to_f64;
use crate::shown::Shown;
use crate::{Mechanism, PositionError, Real};

/// The most inputs that an error has.
const MOST: usize = 3;

/// The values of the inputs at which something failed: of a mechanism with more than three those of the first three. None are
/// known where a function is not told the inputs.
#[derive(Clone, Copy, PartialEq, Default)]
pub struct InputValues {
    names: &'static [&'static str],
    are_angles: &'static [bool],
    values: [f64; MOST],
}

impl InputValues {
    /// The name of each input and its value; angles in radians.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.names.iter().copied().zip(self.values)
    }

    /// True if no input is known.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }
}

/// The inputs in one line, with angles in degrees: `theta = 60°, s = 0.25`; `this input` if none are known.
impl Display for InputValues {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("this input");
        }
        for (place, ((name, value), &is_angle)) in self.iter().zip(self.are_angles).enumerate() {
            f.write_str(if place == 0 { "" } else { ", " })?;
            write!(f, "{name} = ")?;
            Display::fmt(&Shown { value, is_angle }, f)?;
        }
        f.write_str(if self.names.len() > MOST { ", …" } else { "" })
    }
}

impl Debug for InputValues {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

/// A map from names to values.
#[cfg(feature = "serde")]
impl serde::Serialize for InputValues {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

/// The origin of an error: the name of a mechanism, or a mechanism [`at`] its inputs.
pub trait Origin: Copy {
    /// The name of the mechanism.
    fn mechanism(self) -> &'static str;
    /// The error with the inputs, if they are known.
    fn located(self, error: PositionError) -> PositionError;
}

impl Origin for &'static str {
    #[inline(always)]
    fn mechanism(self) -> &'static str {
        self
    }

    #[inline(always)]
    fn located(self, error: PositionError) -> PositionError {
        error
    }
}

/// A mechanism at its inputs, as the origin of errors.
#[derive(Debug, Clone, Copy)]
pub struct At<T, const N: usize> {
    mechanism: &'static str,
    names: &'static [&'static str],
    are_angles: &'static [bool],
    inputs: [T; N],
}

/// A mechanism at these inputs.
#[inline(always)]
pub fn at<M: Mechanism, const N: usize>(inputs: [M::Scalar; N]) -> At<M::Scalar, N> {
    At { mechanism: M::NAME, names: M::INPUTS, are_angles: M::INPUT_ANGLES, inputs }
}

impl<T: Real, const N: usize> Origin for At<T, N> {
    #[inline(always)]
    fn mechanism(self) -> &'static str {
        self.mechanism
    }

    #[inline(always)]
    fn located(self, error: PositionError) -> PositionError {
        let input = |place: usize| self.inputs.get(place).copied().unwrap_or_else(T::zero);
        located(error, self.names, self.are_angles, input(0), input(1), input(2))
    }
}

/// Scalars instead of an array, which would be stored in memory even where nothing fails.
#[cold]
#[inline(never)]
fn located<T: Real>(
    error: PositionError,
    names: &'static [&'static str],
    are_angles: &'static [bool],
    first: T,
    second: T,
    third: T,
) -> PositionError {
    match error {
        PositionError::Unbuildable { mechanism, group, gap, .. } => {
            let values = [first, second, third].map(to_f64);
            PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues { names, are_angles, values } }
        }
        error => error,
    }
}
