//! The check of loops and equations that follow from the others.

use crate::jacobian::ulp::nearly_zero;
use crate::scalar::to_f64;
use crate::{Name, PositionError, Real};

/// True if the residual of an implied loop is zero relative to the sum of the magnitudes of its terms.
///
/// The tolerance is 16 sqrt(epsilon), about 2e-7 in `f64`: at a dead point a position has an error of about sqrt(epsilon),
/// and the residual too. A dimension that is wrong by less is not noticed.
#[inline]
pub fn closes<T: Real>(residual: T, scale: T) -> bool {
    residual.abs() <= nearly_zero::<T>() * scale
}

/// Returns an error if an implied loop or equation does not close, row by row.
///
/// # Errors
/// [`PositionError::NotImplied`] with the name of the first; [`PositionError::NotFinite`] if its residual is not finite.
#[inline]
pub fn implied<T: Real, S: Name, const N: usize>(
    mechanism: S,
    names: [S; N],
    residuals: [T; N],
    scales: [T; N],
) -> Result<(), PositionError<S>> {
    let mut rows = names.into_iter().zip(residuals.into_iter().zip(scales));
    match rows.find(|(_, (residual, scale))| !closes(*residual, *scale)) {
        None => Ok(()),
        Some((equation, (residual, scale))) => Err(open(mechanism, equation, residual / scale)),
    }
}

#[cold]
#[inline(never)]
fn open<T: Real, S: Name>(mechanism: S, equation: S, residual: T) -> PositionError<S> {
    let residual = to_f64(residual.abs());
    if residual.is_finite() {
        PositionError::NotImplied { mechanism, equation, residual }
    } else {
        PositionError::NotFinite { mechanism, quantity: equation }
    }
}
