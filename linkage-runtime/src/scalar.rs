//! The scalars of emitted code.

use core::any::Any;

use nalgebra::{Complex, RealField, Unit, UnitComplex};

use crate::sine;

/// A real scalar that is copied: `f32`, `f64`, dual numbers. Implemented for all that qualify.
pub trait Real: RealField + Copy {
    /// The sine and cosine of an angle in radians: for `f64` up to 1e5 inlined and within 0.85 ulp, else
    /// the scalar's own.
    #[inline(always)]
    #[must_use]
    fn sine_cosine(self) -> (Self, Self) {
        // Which type this is, is known when the code is compiled: nothing of the question is left in it.
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.sin_cos() };
        sine::sin_cos(x).map_or_else(|| beyond(self), |(sine, cosine)| (real(sine), real(cosine)))
    }

    /// The sine alone, as `sine_cosine` gives it.
    #[inline(always)]
    #[must_use]
    fn sine(self) -> Self {
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.sin() };
        sine::sin(x).map_or_else(|| beyond(self).0, real)
    }

    /// The cosine alone, as `sine_cosine` gives it.
    #[inline(always)]
    #[must_use]
    fn cosine(self) -> Self {
        let Some(&x) = (&self as &dyn Any).downcast_ref::<f64>() else { return self.cos() };
        sine::cos(x).map_or_else(|| beyond(self).1, real)
    }

    /// The sines and cosines of several angles, as `sine_cosine` gives them, side by side in vector operations.
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

/// The library's sine and cosine, apart: inlined, a loop that is turned into vectors calls them for every angle.
#[cold]
#[inline(never)]
fn beyond<T: Real>(angle: T) -> (T, T) {
    angle.sin_cos()
}

/// The traits whose functions are those of a scalar that is an associated type: of such a one they are known only where
/// they are imported.
pub mod arithmetic {
    pub use approx::AbsDiffEq as _;
    pub use nalgebra::{ComplexField as _, RealField as _};
    pub use num_traits::{One as _, Zero as _};
}

/// A constant of the formula as a scalar.
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

/// The larger of two numbers; not a number if one of them is none, which `max` and a comparison lose.
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

/// The largest magnitude; not a number if one of the values is none, which nalgebra's `amax` loses.
#[inline]
pub fn largest<T: Real>(values: impl IntoIterator<Item = T>) -> T {
    values.into_iter().fold(T::zero(), |most, value| larger(most, value.abs()))
}

/// The smallest magnitude, of no values the largest number there is; not a number if one of the values is none, which
/// nalgebra's `amin` loses.
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

/// A value relative to its size: zero where both are, and not a number where the size is not finite. Relative to an
/// infinite size everything would be zero.
#[inline]
pub(crate) fn relative<T: Real>(value: T, size: T) -> T {
    // Infinity times zero is not a number.
    let none = size * T::zero();
    if value.is_zero() { none } else { value / size + none }
}

/// The scalar as it is reported.
pub fn to_f64<T: Real>(value: T) -> f64 {
    value.to_subset().unwrap_or(f64::NAN)
}
