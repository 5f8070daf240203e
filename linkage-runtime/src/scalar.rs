//! Scalar types of emitted code.

use core::any::Any;

use nalgebra::{Complex, RealField, Unit, UnitComplex};

use crate::sine;

/// A real scalar that is `Copy`: `f32`, `f64`, dual numbers. It is implemented for all such types.
pub trait Real: RealField + Copy {
    /// The sine and cosine of an angle in radians: for `f64` up to 1e5 inlined and within 0.85 ulp, else
    /// the scalar's own.
    #[inline(always)]
    #[must_use]
    fn sine_cosine(self) -> (Self, Self) {
        // The type is known at compile time, so that this test costs nothing.
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.sin_cos() };
        sine::sin_cos(x).map_or_else(|| beyond(self), |(sine, cosine)| (real(sine), real(cosine)))
    }

    /// The sine alone, equal to that of `sine_cosine`.
    #[inline(always)]
    #[must_use]
    fn sine(self) -> Self {
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.sin() };
        sine::sin(x).map_or_else(|| beyond(self).0, real)
    }

    /// The cosine alone, equal to that of `sine_cosine`.
    #[inline(always)]
    #[must_use]
    fn cosine(self) -> Self {
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.cos() };
        sine::cos(x).map_or_else(|| beyond(self).1, real)
    }

    /// The sines and cosines of several angles, equal to those of `sine_cosine`, computed by vector instructions.
    #[inline(always)]
    #[must_use]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let Some(x) = (&angles as &dyn Any).downcast_ref::<[f64; N]>() else { return angles.map(Self::sin_cos) };
        sine::sines_cosines(x).map_or_else(
            || angles.map(Self::sine_cosine),
            |values| values.map(|(sine, cosine)| (real(sine), real(cosine))),
        )
    }
}

impl<T: RealField + Copy> Real for T {}

/// The standard library's sine and cosine. It is not inlined: a vectorised loop would call them for every angle.
#[cold]
#[inline(never)]
fn beyond<T: Real>(angle: T) -> (T, T) {
    angle.sin_cos()
}

/// Traits to import for the functions of a scalar that is an associated type.
pub mod arithmetic {
    pub use approx::AbsDiffEq as _;
    pub use nalgebra::{ComplexField as _, RealField as _};
    pub use num_traits::{One as _, Zero as _};
}

/// Converts a constant to a scalar.
#[inline]
#[must_use]
pub fn real<T: Real>(value: f64) -> T {
    nalgebra::convert(value)
}

/// The direction with this cosine and sine, whose squares add up to 1.
#[inline]
#[must_use]
pub fn unit<T: Real>(cosine: T, sine: T) -> UnitComplex<T> {
    Unit::new_unchecked(Complex { re: cosine, im: sine })
}

/// The larger of two numbers; NaN if one of them is, unlike `max`.
#[inline]
pub fn larger<T: Real>(a: T, b: T) -> T {
    if a >= b {
        a
    } else if b >= a {
        b
    } else {
        a + b
    }
}

/// The largest magnitude; NaN if one of the values is, unlike nalgebra's `amax`.
#[inline]
pub fn largest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
    values.into_iter().fold(T::zero(), |most, value| larger(most, value.abs()))
}

/// The smallest magnitude, or the largest number of the type if there are no values; NaN if one of the values is,
/// unlike nalgebra's `amin`.
#[inline]
pub fn smallest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
    let none = T::max_value().unwrap_or_else(T::one);
    values.into_iter().fold(none, |least, value| {
        let value = value.abs();
        if least <= value {
            least
        } else if value <= least {
            value
        } else {
            least + value
        }
    })
}

/// `value` / `scale`, where 0 / 0 = 0; NaN if the scale is not finite, since any value divided by infinity would be
/// zero.
#[inline]
pub(crate) fn relative<T: Real>(value: T, scale: T) -> T {
    // Infinity times zero is NaN.
    let none = scale * T::zero();
    if value.is_zero() { none } else { value / scale + none }
}

/// Converts a scalar to `f64` for reports; NaN if it has no such value.
pub fn to_f64<T: Real>(value: T) -> f64 {
    value.to_subset().unwrap_or(f64::NAN)
}
