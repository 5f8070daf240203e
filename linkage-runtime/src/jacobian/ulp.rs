//! Tolerances. Each is in ulps, multiples of the epsilon of the scalar, unless it says otherwise.

use crate::{Real, real};

/// `number` times epsilon.
pub fn ulps<T: Real>(number: f64) -> T {
    T::default_epsilon() * real(number)
}

/// A residual, a determinant or a singular value counts as zero up to this many ulps of the sum of the magnitudes of
/// its terms: two stored angles are off by half an ulp of pi each, and their difference by two ulps. At 1, links in
/// line at some angle do not count as singular; at 16, a dead centre loses digits.
pub const ZERO_ULPS: f64 = 4.0;

/// Coordinates, steps and second derivatives count as equal up to this many ulps of their scale: the error of a dozen
/// operations. From 4 to 64 every path of the tests is the same; at 256 motions that only come close to each other
/// count as crossing.
pub const EQUAL_ULPS: f64 = 16.0;

/// 16 sqrt(epsilon): a pivot or a rate that is no larger than this, relative to the largest, may be zero. Where motions
/// cross, the position is a double root, which rounding errors move by their square root, and a pivot is as accurate
/// as the position. From 4 to 64 sqrt(epsilon) every path of the tests is the same.
pub fn nearly_zero<T: Real>() -> T {
    T::default_epsilon().sqrt() * real(16.0)
}
