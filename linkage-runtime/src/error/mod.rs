//! Errors: an enum each for positions, for paths and for invalid input.

mod digits;
mod input;
mod inputs;
mod name;
mod path;
mod position;
#[cfg(test)]
mod tests;

use core::iter::Empty;

use nalgebra::SMatrix;

pub use input::InputError;
pub use inputs::InputValues;
pub use name::{BorrowedName, Name};
pub use path::PathError;
pub use position::PositionError;

use crate::Real;

/// Returns an error if a value is infinite or NaN.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite<T: Real, S: Name, const N: usize>(
    mechanism: S,
    quantity: S,
    values: [T; N],
) -> Result<(), PositionError<S>> {
    all_finite(mechanism, quantity, values.iter())
}

/// The error of a mechanism whose position has no closed form.
///
/// # Errors
/// [`PositionError::NoClosedForm`].
pub const fn no_closed_form<P, S: Name>(mechanism: S, group: S) -> Result<P, PositionError<S>> {
    Err(PositionError::NoClosedForm { mechanism, group })
}

/// The list of positions of a mechanism with a group that has none.
///
/// # Errors
/// [`PositionError::NoClosedForm`].
pub const fn no_list<P, S: Name>(mechanism: S, group: S) -> Result<Empty<P>, PositionError<S>> {
    Err(PositionError::NoClosedForm { mechanism, group })
}

/// The list of positions of a mechanism with more branches than a list can have.
///
/// # Errors
/// [`PositionError::TooManyBranches`].
pub const fn too_many_branches<P, S: Name>(mechanism: S) -> Result<Empty<P>, PositionError<S>> {
    Err(PositionError::TooManyBranches { mechanism })
}

/// Returns an error if an entry of the matrix is infinite or NaN.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn finite_matrix<T: Real, S: Name, const R: usize, const C: usize>(
    mechanism: S,
    quantity: S,
    matrix: &SMatrix<T, R, C>,
) -> Result<(), PositionError<S>> {
    all_finite(mechanism, quantity, matrix.iter())
}

/// Returns an error if one of any number of values is infinite or NaN.
///
/// # Errors
/// [`PositionError::NotFinite`] with these names.
#[inline]
pub fn all_finite<'a, T: Real, S: Name>(
    mechanism: S,
    quantity: S,
    values: impl Iterator<Item = &'a T> + Clone,
) -> Result<(), PositionError<S>> {
    // A sum is finite only if all its terms are, and takes a single test; but the sum of finite terms may overflow.
    let sum = values.clone().copied().reduce(|sum, value| sum + value);
    if sum.is_none_or(|sum| sum.is_finite()) {
        return Ok(());
    }
    if each_is_finite(values) { Ok(()) } else { Err(PositionError::NotFinite { mechanism, quantity }) }
}

/// A function of its own, because a call of a cold one makes its branch unlikely.
#[cold]
fn each_is_finite<'a, T: Real>(mut values: impl Iterator<Item = &'a T>) -> bool {
    values.all(T::is_finite)
}
