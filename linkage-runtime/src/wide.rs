//! Twice the precision for groups that are nearly singular.
//!
//! A factorisation loses as many digits as its smallest pivot is small: with pivot p the solution has a relative error
//! of about eps / p, most of it from the rounded entries of J, so that iterative refinement with these entries regains
//! nothing. The emitted functions, generic over their scalar, then compute in [`Wide`] from the stored angles, and round
//! once.

use linkage_double::DoubleDouble;
use nalgebra::{SMatrix, SVector, UnitComplex};

use crate::native::is_native;
use crate::scalar::{to_f64, unit};
use crate::{Real, real};

/// The scalar of twice the precision: it takes `f32` and `f64` exactly.
pub type Wide = DoubleDouble;

/// The smallest pivot of an equilibrated block, at most about 1, below which it is solved in twice the precision.
const SMALLEST_PIVOT: f64 = 0.015_625;

/// True if a group with this smallest pivot loses digits that [`Wide`] keeps: that of another scalar has its own digits.
#[inline]
pub(crate) fn loses_digits<T: Real>(smallest_pivot: T) -> bool {
    is_native::<T>() && smallest_pivot < real(SMALLEST_PIVOT)
}

/// The number in twice the precision.
#[must_use]
pub fn widened<T: Real>(value: T) -> Wide {
    to_f64(value).into()
}

/// The direction in twice the precision, as stored.
#[must_use]
pub fn widened_direction<T: Real>(direction: UnitComplex<T>) -> UnitComplex<Wide> {
    unit(widened(direction.re), widened(direction.im))
}

/// The matrix in twice the precision.
#[must_use]
pub fn widened_matrix<T: Real, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>) -> SMatrix<Wide, R, C> {
    matrix.map(widened)
}

/// The numbers by name in twice the precision.
#[must_use]
pub fn widened_by_name<T, A, B, const N: usize>(by_name: A) -> B
where
    T: Real,
    SVector<T, N>: From<A>,
    B: From<SVector<Wide, N>>,
{
    SVector::from(by_name).map(widened).into()
}

/// The matrix rounded; `None` if a number is not finite.
#[must_use]
pub fn rounded_matrix<T: Real, const R: usize, const C: usize>(wide: SMatrix<Wide, R, C>) -> Option<SMatrix<T, R, C>> {
    let rounded = wide.map(|entry| real::<T>(entry.high()));
    rounded.iter().all(T::is_finite).then_some(rounded)
}

/// The matrices rounded, as [`rounded_matrix`].
#[must_use]
pub fn rounded_matrices<T: Real, const R: usize, const C: usize, const N: usize>(
    wide: [SMatrix<Wide, R, C>; N],
) -> Option<[SMatrix<T, R, C>; N]> {
    let rounded = wide.map(|wide| rounded_matrix(wide).unwrap_or_else(|| SMatrix::repeat(real(f64::NAN))));
    rounded.iter().flatten().all(T::is_finite).then_some(rounded)
}

/// The numbers by name rounded, as [`rounded_matrix`].
#[must_use]
pub fn rounded_by_name<T, A, B, const N: usize>(wide: A) -> Option<B>
where
    T: Real,
    SVector<Wide, N>: From<A>,
    B: From<SVector<T, N>>,
{
    rounded_matrix(SVector::from(wide)).map(B::from)
}
