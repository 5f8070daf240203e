//! The regularity test of a Jacobian, and groups of more than two unknowns.

use crate::bounded::has_bound;
use crate::dense::Lu;
use crate::jacobian::ulp::{ZERO_ULPS, ulps};
use crate::native::{self, native};
use crate::scalar::{greatest, largest, smallest, to_f64};
use crate::wide::loses_digits;
use crate::{Name, PositionError, Real, real};

/// Returns an error if the determinant of a group of unknowns is zero to rounding error, relative to `scale`, the
/// largest value that it can take; the sign of `scale` does not matter.
///
/// # Errors
/// [`PositionError::Singular`], or [`PositionError::NotFinite`] if either is not a finite number.
#[inline]
pub fn regular<T: Real, S: Name>(mechanism: S, group: S, determinant: T, scale: T) -> Result<(), PositionError<S>> {
    if is_nonzero(determinant, scale) && determinant.abs() <= greatest() {
        return Ok(());
    }
    // The error is put together here: a compiler that does not see a function return an error goes on behind the call.
    Err(match regularity(determinant, scale) {
        Some(regularity) => PositionError::Singular { mechanism, group, regularity },
        None => PositionError::NotFinite { mechanism, quantity: S::from_static("the Jacobian") },
    })
}

/// True if the determinant of a group of unknowns is not zero to rounding error, relative to `scale`.
#[inline]
pub fn is_nonzero<T: Real>(determinant: T, scale: T) -> bool {
    determinant.abs() > ulps::<T>(ZERO_ULPS) * scale.abs()
}

/// True if numbers have the same signs, pair by pair; zero counts as positive.
#[inline]
pub fn same_signs<T: Real>(these: &[T], those: &[T]) -> bool {
    these.iter().zip(those).all(|(this, that)| (*this >= T::zero()) == (*that >= T::zero()))
}

/// The determinant relative to its scale. `None` if either is not a finite number.
#[cold]
#[inline(never)]
fn regularity<T: Real>(determinant: T, scale: T) -> Option<f64> {
    let is_finite = determinant.is_finite() && scale.is_finite();
    // A determinant of scale zero is singular.
    is_finite.then(|| if scale.is_zero() { 0.0 } else { to_f64((determinant / scale).abs()) })
}

/// J of a group of `N` unknowns, equilibrated and factorised with partial pivoting.
#[derive(Debug, Clone)]
pub struct Factorization<T: Real, const N: usize> {
    factors: Lu<T, N>,
    rows: [T; N],
    columns: [T; N],
    /// True if [`refined`](Self::refined) asks for more digits.
    loses_digits: bool,
}

impl<T: Real, const N: usize> Factorization<T, N> {
    /// Factorises the matrix of these columns; `scales` are those of its rows.
    ///
    /// Rows are divided by the scales of their residuals and columns by their largest entry, so that neither the pivots
    /// nor the test for singularity depend on units.
    ///
    /// # Errors
    /// [`PositionError::Singular`] if the smallest pivot is no larger than its rounding error,
    /// [`PositionError::NotFinite`] if an entry is not a finite number.
    pub fn new<S: Name>(
        mechanism: S,
        group: S,
        mut columns: [[T; N]; N],
        scales: [T; N],
    ) -> Result<Self, PositionError<S>> {
        let row_factors = scales.map(unit_of);
        let mut column_factors = [T::one(); N];
        for (column, column_factor) in columns.iter_mut().zip(&mut column_factors) {
            for (entry, factor) in column.iter_mut().zip(&row_factors) {
                *entry *= *factor;
            }
            *column_factor = unit_of(largest(column.iter().copied()));
            for entry in column {
                *entry *= *column_factor;
            }
        }
        if !columns.as_flattened().iter().all(T::is_finite) {
            return Err(PositionError::NotFinite { mechanism, quantity: S::from_static("the Jacobian") });
        }
        let factors = Lu::of(columns);
        let smallest = smallest(factors.pivots());
        if smallest > ulps(ZERO_ULPS * real_count(N)) {
            let loses_digits = loses_digits(smallest);
            Ok(Self { factors, rows: row_factors, columns: column_factors, loses_digits })
        } else {
            Err(PositionError::Singular { mechanism, group, regularity: to_f64(smallest) })
        }
    }

    /// Solves J x = `right`.
    #[must_use]
    pub fn solve(&self, mut right: [T; N]) -> [T; N] {
        for (entry, factor) in right.iter_mut().zip(&self.rows) {
            *entry *= *factor;
        }
        let mut x = self.factors.solve(&right);
        for (entry, factor) in x.iter_mut().zip(&self.columns) {
            *entry *= *factor;
        }
        x
    }

    /// A result of solutions, or the `precise` one if there is one and the smallest pivot makes rounding errors large.
    #[inline(always)]
    pub fn refined<X: Copy>(&self, rough: X, precise: impl FnOnce(X) -> Option<X>) -> X {
        if self.loses_digits {
            return precise(rough).unwrap_or(rough);
        }
        rough
    }
}

/// The power of two that scales `scale` to a number near 1; 1 if `scale` is not positive.
fn unit_of<T: Real>(scale: T) -> T {
    if scale > T::zero() { power_of_two_below(scale).recip() } else { T::one() }
}

fn real_count(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

/// A power of two near `value`; scaling by it is exact.
#[inline]
pub(crate) fn power_of_two_below<T: Real>(value: T) -> T {
    if has_bound::<T>() {
        return real(power_of_two_below(to_f64(value)));
    }
    native!(value => native::power_of_two_below; else by_logarithm(value))
}

/// The power of two for other scalars.
#[cold]
#[inline(never)]
fn by_logarithm<T: Real>(value: T) -> T {
    let two = real::<T>(2.0);
    let exponent = value.log2().floor();
    let power = two.powf(exponent);
    if power.is_finite() && power > T::zero() { power } else { T::one() }
}

/// The determinant of a group of more than two unknowns, given by columns.
#[must_use]
pub fn product_of_pivots<T: Real, const N: usize>(columns: [[T; N]; N]) -> T {
    let factors = Lu::of(columns);
    factors.pivots().fold(T::one(), |product, pivot| product * pivot) * factors.sign()
}
