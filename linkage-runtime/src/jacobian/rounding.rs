//! What counts as rounding. Each number is in roundings, multiples of the epsilon of the scalar, unless it says otherwise.

use crate::{Real, real};

/// So many roundings of a number of size 1.
pub fn roundings<T: Real>(number: f64) -> T {
    T::default_epsilon() * real(number)
}

/// A closure is closed, and a determinant or a singular value zero, within this many roundings of the magnitudes that it is
/// made of: of stored angles two are off by half a rounding of pi each, and their difference by two. It is as sharp as it
/// looks: at 1 links in line at some angle are not singular, at 16 a dead centre loses digits.
pub const CLOSED: f64 = 4.0;

/// Coordinates, steps and second derivatives are the same within this many roundings of their size: what a dozen operations
/// leave, each on the results of the others. From 4 to 64 every path of the tests is the same; at 256 motions that only
/// come near each other are taken for a crossing.
pub const SAME: f64 = 16.0;

/// What is no larger beside the largest of its kind may be zero: where motions cross a pivot is, as far as its place is
/// known, and rounding moves that by its root. In roots of roundings; from 4 to 64 of them every path of the tests is the
/// same.
pub fn weak<T: Real>() -> T {
    T::default_epsilon().sqrt() * real(16.0)
}
