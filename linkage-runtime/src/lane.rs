//! The forms of functions for loops over several positions, which a compiler vectorises: without branches. Those of
//! elementary functions are right for `f64` and `f32` only where a predicate holds; there they equal the methods of
//! `Real` bit for bit. Other scalars have their own functions, right everywhere.

pub use crate::chord::{
    chord_in_lane as chord, elbow_chord_in_lane as elbow_chord, reach_chord_in_lane as reach_chord,
};
use crate::native::native;
use crate::{arctangent, hypotenuse, sine};
use nalgebra::RealField;

/// The sine and cosine, if `is_moderate`.
#[inline(always)]
#[must_use]
pub fn sine_cosine<T: RealField + Copy>(x: T) -> (T, T) {
    native!(x => sine::both; else x.sin_cos())
}

/// The sine, if `is_moderate`.
#[inline(always)]
#[must_use]
pub fn sine<T: RealField + Copy>(x: T) -> T {
    native!(x => sine::both; else (x.sin(), x)).0
}

/// The cosine, if `is_moderate`.
#[inline(always)]
#[must_use]
pub fn cosine<T: RealField + Copy>(x: T) -> T {
    native!(x => sine::both; else (x, x.cos())).1
}

/// True for an angle whose sine and cosine are right.
#[inline(always)]
#[must_use]
pub fn is_moderate<T: RealField + Copy>(x: T) -> bool {
    native!(x => sine::is_moderate).unwrap_or(true)
}

/// The angle of (x, y) with the x axis, if `has_arctangent2`.
#[inline(always)]
#[must_use]
pub fn arctangent2<T: RealField + Copy>(y: T, x: T) -> T {
    native!((y, x) => arctangent::arctangent2; else y.atan2(x))
}

/// True if `arctangent2` is right: not if both arguments are zero or one is very small, very large or NaN.
#[inline(always)]
#[must_use]
pub fn has_arctangent2<T: RealField + Copy>(y: T, x: T) -> bool {
    native!((y, x) => arctangent::is_regular).unwrap_or(true)
}

/// The length of (x, y), if `has_hypotenuse`.
#[inline(always)]
#[must_use]
pub fn hypotenuse<T: RealField + Copy>(x: T, y: T) -> T {
    native!((x, y) => hypotenuse::hypotenuse; else x.hypot(y))
}

/// True if `hypotenuse` is right: not if both arguments are zero or very small, or one is very large or NaN.
#[inline(always)]
#[must_use]
pub fn has_hypotenuse<T: RealField + Copy>(x: T, y: T) -> bool {
    native!((x, y) => hypotenuse::is_regular).unwrap_or(true)
}

/// True if a distance is not negative, as [`reachable`](crate::__rt::reachable) requires.
#[inline(always)]
#[must_use]
pub fn is_reachable<T: RealField + Copy>(distance: T) -> bool {
    distance >= T::zero()
}

/// True if a determinant is not zero, as [`solvable`](crate::__rt::solvable) requires.
#[inline(always)]
#[must_use]
pub fn is_solvable<T: RealField + Copy>(determinant: T) -> bool {
    !determinant.is_zero()
}
