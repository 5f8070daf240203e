//! Why there is no result: an enum for each thing that can be attempted.

mod input;
mod path;
mod position;

use nalgebra::SMatrix;

pub use input::InputError;
pub use path::PathError;
pub use position::PositionError;

use crate::Real;

/// Refuses values that are infinite or not numbers.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite<T: Real, const N: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    values: [T; N],
) -> Result<(), PositionError> {
    all_finite(mechanism, quantity, values.iter())
}

/// Refuses a matrix with an entry that is infinite or not a number.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_matrix<T: Real, const R: usize, const C: usize>(
    mechanism: &'static str,
    quantity: &'static str,
    matrix: &SMatrix<T, R, C>,
) -> Result<(), PositionError> {
    all_finite(mechanism, quantity, matrix.iter())
}

/// As [`finite`], of any number of values.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn all_finite<'a, T: Real>(
    mechanism: &'static str,
    quantity: &'static str,
    values: impl Iterator<Item = &'a T> + Clone,
) -> Result<(), PositionError> {
    // A sum is finite only if all its terms are, and takes one verdict; but it may be too large where none is.
    let sum = values.clone().copied().reduce(|sum, value| sum + value);
    if sum.is_none_or(|sum| sum.is_finite()) || values.clone().all(T::is_finite) {
        Ok(())
    } else {
        Err(PositionError::NotFinite { mechanism, quantity })
    }
}
