//! Scalar types of emitted code.

use nalgebra::{Complex, RealField, Unit, UnitComplex};

use crate::native::{native, same};
use crate::{elementary, hypotenuse, lane, sine};

/// A real scalar that is `Copy`: `f32`, `f64`, dual numbers. It is implemented for all such types.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scalar of mechanisms",
    note = "use `f64`, `f32` or `DoubleDouble`; an integer is written with a point, as in `2.0`"
)]
pub trait Real: RealField + Copy {
    /// The sine and cosine of an angle in radians: for `f64` up to 1e5 and every `f32` within 0.89 ulp, inlined up to
    /// 1e5 and 1e4; other scalars have their own.
    #[inline(always)]
    #[must_use]
    fn sine_cosine(self) -> (Self, Self) {
        if lane::is_moderate(self) { lane::sine_cosine(self) } else { beyond(self) }
    }

    /// The sine alone, equal to that of `sine_cosine`.
    #[inline(always)]
    #[must_use]
    fn sine(self) -> Self {
        if !lane::is_moderate(self) {
            return beyond(self).0;
        }
        native!(self => sine::sine; else self.sin())
    }

    /// The cosine alone, equal to that of `sine_cosine`.
    #[inline(always)]
    #[must_use]
    fn cosine(self) -> Self {
        if !lane::is_moderate(self) {
            return beyond(self).1;
        }
        native!(self => sine::cosine; else self.cos())
    }

    /// The sines and cosines of several angles, equal to those of `sine_cosine`, computed by vector instructions.
    #[inline(always)]
    #[must_use]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        if !angles.iter().fold(true, |within, angle| within & lane::is_moderate(*angle)) {
            return one_by_one(angles);
        }
        native!(angles => sine::several, N; else angles.map(Self::sin_cos))
    }

    /// The angle of (x, y) with the x axis, from -pi to pi, where `self` is y: for `f64` and `f32` inlined and within
    /// 0.98 ulp (the largest error found is 0.73), and a call for zero and extreme arguments; other scalars have their own.
    #[inline(always)]
    #[must_use]
    fn arctangent2(self, x: Self) -> Self {
        if lane::has_arctangent2(self, x) { lane::arctangent2(self, x) } else { extreme_angle(self, x) }
    }

    /// The length of (x, y), where `self` is x: for `f64` and `f32` inlined and within 1.25 ulp, with the same digits in
    /// every unit, else the scalar's own. A subnormal length is within 1.25 ulp, too.
    #[inline(always)]
    #[must_use]
    fn hypotenuse(self, y: Self) -> Self {
        if lane::has_hypotenuse(self, y) { lane::hypotenuse(self, y) } else { extreme_length(self, y) }
    }

    /// The tangent of an angle in radians: for `f64` and `f32` within 1 ulp, with the same bits on every target, else the
    /// scalar's own. So are the functions below.
    #[inline]
    #[must_use]
    fn tangent(self) -> Self {
        native!(self => elementary::tangent; else self.tan())
    }

    /// The angle between -pi/2 and pi/2 with this sine.
    #[inline]
    #[must_use]
    fn arcsine(self) -> Self {
        native!(self => elementary::arcsine; else self.asin())
    }

    /// The angle between 0 and pi with this cosine.
    #[inline]
    #[must_use]
    fn arccosine(self) -> Self {
        native!(self => elementary::arccosine; else self.acos())
    }

    /// The angle between -pi/2 and pi/2 with this tangent.
    #[inline]
    #[must_use]
    fn arctangent(self) -> Self {
        native!(self => elementary::arctangent; else self.atan())
    }

    /// The exponential function.
    #[inline]
    #[must_use]
    fn exponential(self) -> Self {
        native!(self => elementary::exponential; else self.exp())
    }

    /// The natural logarithm.
    #[inline]
    #[must_use]
    fn logarithm(self) -> Self {
        native!(self => elementary::logarithm; else self.ln())
    }

    /// `value`, or its limit where `self` is zero and the value may not be a number.
    #[inline(always)]
    #[must_use]
    fn if_nonzero(self, value: Self, limit: Self) -> Self {
        if self == Self::zero() { limit } else { value }
    }
}

impl<T: RealField + Copy> Real for T {}

/// The sine and cosine of a large angle. It is not inlined: a vectorised loop would call them for every angle.
#[cold]
#[inline(never)]
fn beyond<T: Real>(angle: T) -> (T, T) {
    native!(angle => sine::beyond; else angle.sin_cos())
}

/// The sines and cosines of angles of which some are beyond this crate's range.
#[cold]
#[inline(never)]
fn one_by_one<T: Real, const N: usize>(angles: [T; N]) -> [(T, T); N] {
    angles.map(T::sine_cosine)
}

/// The angle of extreme arguments.
#[cold]
#[inline(never)]
fn extreme_angle<T: Real>(y: T, x: T) -> T {
    native!((y, x) => elementary::arctangent2; else y.atan2(x))
}

/// The length of scaled sides, or the scalar's own.
#[cold]
#[inline(never)]
fn extreme_length<T: Real>(x: T, y: T) -> T {
    native!((x, y) => hypotenuse::scaled; else x.hypot(y))
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

/// An integer as a scalar.
#[inline]
pub(crate) fn whole<T: Real>(number: i32) -> T {
    // Not by way of a double, which a small processor has none of.
    match same(number as f32) {
        Some(number) => number,
        None => real(f64::from(number)),
    }
}

/// The integer nearest to a scalar; the largest or least one if it is beyond, 0 for NaN.
#[inline]
pub(crate) fn rounded<T: Real>(value: T) -> i32 {
    let value = value.round();
    match same::<T, f32>(value) {
        Some(value) => value as i32,
        None => to_f64(value) as i32,
    }
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

/// The largest finite number of the type. A comparison with it takes fewer instructions than `is_finite`, which moves
/// the bits to an integer register.
#[inline(always)]
pub fn greatest<T: Real>() -> T {
    T::max_value().unwrap_or(real(f64::INFINITY))
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
    values.into_iter().fold(greatest(), |least, value| {
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

/// The value of a scalar as `f64`, for reports and decisions.
pub fn to_f64<T: Real>(value: T) -> f64 {
    nalgebra::convert_unchecked(value)
}
