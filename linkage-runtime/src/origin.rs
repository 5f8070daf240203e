//! The origin of an error about a position: a mechanism and, where they are known, its inputs.

use crate::error::InputValues;
use crate::scalar::to_f64;
use crate::{Mechanism, PositionError, Real};

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
pub fn at<M: Mechanism, const N: usize>(_: &M, inputs: [M::Scalar; N]) -> At<M::Scalar, N> {
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
            PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues::new(names, are_angles, values) }
        }
        error => error,
    }
}
