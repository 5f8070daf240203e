//! The rounding errors below which a sum, a gap or a pivot counts as zero.

use linkage_runtime::__shared::to_f64;
use linkage_runtime::{BorrowedName, InputError, Real, real};

/// A rate or a gap below this many ulps of the magnitudes of its terms counts as zero.
pub(super) const ZERO_ULPS: f64 = 16.0;

/// 1024 ulps: a pivot counts as zero if it is no larger than this times its diagonal entry of A, a sum if it is no
/// larger than this times the sum of the magnitudes of its terms.
pub(super) fn held_tolerance<T: Real>() -> T {
    real::<T>(1024.0) * T::default_epsilon()
}

/// The rounding error of the gap between s and a bound.
pub(super) fn gap_tolerance<T: Real>(value: T, bound: T) -> T {
    sum_tolerance(value.abs() + bound.abs())
}

/// The rounding error of a sum whose terms have the magnitudes `size` in total.
pub(crate) fn sum_tolerance<T: Real>(size: T) -> T {
    real::<T>(ZERO_ULPS) * T::default_epsilon() * size
}

/// True if a sum is zero to rounding error, where `size` is the sum of the magnitudes of its terms.
pub(super) fn is_negligible<T: Real>((sum, size): (T, T)) -> bool {
    sum.abs() <= sum_tolerance(size)
}

/// Checks that a scalar is not beyond its stops by more than its tolerance.
pub(crate) fn within<T: Real, N: BorrowedName>(
    scene: N,
    stop: N,
    (value, resolution): (T, T),
    [lower, upper]: [T; 2],
) -> Result<(), InputError<N>> {
    for (gap, bound) in [(lower - value, lower), (value - upper, upper)] {
        if gap > resolution.max(gap_tolerance(value, bound)) {
            return Err(InputError::BeyondStop { scene, stop, gap: to_f64(gap) });
        }
    }
    Ok(())
}
