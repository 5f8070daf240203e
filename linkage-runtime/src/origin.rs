//! The origin of an error about a position: a mechanism and, where they are known, its inputs.

use crate::error::{InputValues, Name};
use crate::scalar::to_f64;
use crate::{Mechanism, PositionError, Real};

/// The origin of an error: the name of a mechanism, or a mechanism [`at`] its inputs.
pub trait Origin: Copy {
    /// The type of the names.
    type Name: Name + Copy;
    /// The name of the mechanism.
    fn mechanism(self) -> Self::Name;
    /// The error with the inputs, if they are known.
    fn located(self, error: PositionError<Self::Name>) -> PositionError<Self::Name>;
}

impl<'a> Origin for &'a str {
    type Name = &'a str;

    #[inline(always)]
    fn mechanism(self) -> &'a str {
        self
    }

    #[inline(always)]
    fn located(self, error: PositionError<&'a str>) -> PositionError<&'a str> {
        error
    }
}

/// A mechanism at its inputs, as the origin of errors.
#[derive(Debug, Clone, Copy)]
pub struct At<'a, T, S: Name, const N: usize> {
    mechanism: S,
    names: S::List,
    are_angles: &'a [bool],
    inputs: [T; N],
}

/// A mechanism at these inputs.
#[inline(always)]
pub fn at<M: Mechanism, const N: usize>(_: &M, inputs: [M::Scalar; N]) -> At<'static, M::Scalar, &'static str, N> {
    at_named(M::NAME, M::INPUTS, M::INPUT_ANGLES, inputs)
}

/// The mechanism of this name at these inputs: their names, and for each true if it is an angle.
#[inline(always)]
pub fn at_named<T, S: Name, const N: usize>(
    mechanism: S,
    names: S::List,
    are_angles: &[bool],
    inputs: [T; N],
) -> At<'_, T, S, N> {
    At { mechanism, names, are_angles, inputs }
}

impl<T: Real, S: Name<List: Copy> + Copy, const N: usize> Origin for At<'_, T, S, N> {
    type Name = S;

    #[inline(always)]
    fn mechanism(self) -> S {
        self.mechanism
    }

    #[inline(always)]
    fn located(self, error: PositionError<S>) -> PositionError<S> {
        let input = |place: usize| self.inputs.get(place).copied().unwrap_or_else(T::zero);
        located(error, self.names, self.are_angles, input(0), input(1), input(2))
    }
}

/// Scalars instead of an array, which would be stored in memory even where nothing fails.
#[cold]
#[inline(never)]
fn located<T: Real, S: Name>(
    error: PositionError<S>,
    names: S::List,
    are_angles: &[bool],
    first: T,
    second: T,
    third: T,
) -> PositionError<S> {
    match error {
        PositionError::Unbuildable { mechanism, group, gap, .. } => {
            let values = [first, second, third].map(to_f64);
            PositionError::Unbuildable { mechanism, group, gap, inputs: InputValues::new(names, are_angles, values) }
        }
        error => error,
    }
}
