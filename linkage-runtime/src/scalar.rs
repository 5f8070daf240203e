//! The scalars of emitted code.

use nalgebra::{Complex, RealField, Unit, UnitComplex};

/// A real scalar that is copied: `f32`, `f64`, dual numbers. Implemented for all that qualify.
pub trait Real: RealField + Copy {}

impl<T: RealField + Copy> Real for T {}

/// A constant of the formula as a scalar.
#[inline]
#[must_use]
pub fn real<T: Real>(value: f64) -> T {
    nalgebra::convert(value)
}

/// The direction (cos, sin) of an angle in radians.
#[inline]
#[must_use]
pub fn direction<T: Real>(angle: T) -> UnitComplex<T> {
    let (sine, cosine) = angle.sin_cos();
    Unit::new_unchecked(Complex { re: cosine, im: sine })
}

/// The scalar as it is reported.
pub(crate) fn to_f64<T: Real>(value: T) -> f64 {
    value.to_subset().unwrap_or(f64::NAN)
}
