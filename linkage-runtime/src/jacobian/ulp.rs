//! Tolerances. Each is in ulps, multiples of the epsilon of the scalar, unless it says otherwise.

use crate::{Real, real};

/// `number` times epsilon.
pub fn ulps<T: Real>(number: f64) -> T {
    T::default_epsilon() * real(number)
}

/// A residual, a determinant or a singular value is zero within this many ulps of the magnitudes of its terms: two
/// stored angles are off by half an ulp of pi each, and their difference by two ulps. At 1, links in line at some angle
/// do not count as singular; at 16, a dead centre loses digits.
pub const ZERO_ULPS: f64 = 4.0;

/// Coordinates, steps and second derivatives are equal within this many ulps of their scale: the error of a dozen
/// operations. From 4 to 64 every path of the tests is the same; at 256 motions that only come close to each other
/// count as crossing.
pub const EQUAL_ULPS: f64 = 16.0;

/// 16 sqrt(epsilon): a value that is no larger, relative to the largest of its kind, may be zero. Where motions cross,
/// a pivot is as accurate as the position, and rounding errors move the position by their square root. From 4 to 64
/// sqrt(epsilon) every path of the tests is the same.
pub fn weak<T: Real>() -> T {
    T::default_epsilon().sqrt() * real(16.0)
}
