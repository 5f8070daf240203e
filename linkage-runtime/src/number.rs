//! Numbers of formulas without comparisons.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::ComplexField;

use crate::Real;

/// A number that formulas without comparisons accept: a real scalar, an interval, a truncated power series of either.
///
/// Unlike [`Real`] it has no order, so that an interval, which has none, cannot be compared by mistake. A function whose
/// argument is outside its domain returns [`unknown`](Self::unknown).
pub trait Number:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// This double, exactly.
    fn exactly(value: f64) -> Self;
    /// A number of which this is the nearest double.
    fn near(value: f64) -> Self;
    /// A number of which nothing is known: NaN for a scalar, the real line for an interval.
    fn unknown() -> Self;
    /// Pi.
    fn pi() -> Self;
    /// The square; of an interval it is never negative, unlike its product with itself.
    #[must_use]
    fn square(self) -> Self;
    /// The magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The exponential function.
    #[must_use]
    fn exponential(self) -> Self;
    /// The natural logarithm.
    #[must_use]
    fn logarithm(self) -> Self;
    /// The sine and cosine of an angle in radians.
    #[must_use]
    fn sine_cosine(self) -> (Self, Self);
    /// The tangent of an angle in radians.
    #[must_use]
    fn tangent(self) -> Self;
    /// The angle between -pi/2 and pi/2 with this sine.
    #[must_use]
    fn arcsine(self) -> Self;
    /// The angle between 0 and pi with this cosine.
    #[must_use]
    fn arccosine(self) -> Self;
    /// The angle between -pi/2 and pi/2 with this tangent.
    #[must_use]
    fn arctangent(self) -> Self;
    /// The angle of (x, y) with the x axis, where `self` is y.
    #[must_use]
    fn arctangent2(self, x: Self) -> Self;
    /// The length of (x, y), where `self` is x.
    #[must_use]
    fn hypotenuse(self, y: Self) -> Self;

    /// Zero.
    #[must_use]
    fn zero() -> Self {
        Self::exactly(0.0)
    }
    /// One.
    #[must_use]
    fn one() -> Self {
        Self::exactly(1.0)
    }
    /// The quotient of two doubles.
    #[must_use]
    fn ratio(numerator: f64, denominator: f64) -> Self {
        Self::exactly(numerator) / Self::exactly(denominator)
    }
    /// The sine.
    #[must_use]
    fn sine(self) -> Self {
        self.sine_cosine().0
    }
    /// The cosine.
    #[must_use]
    fn cosine(self) -> Self {
        self.sine_cosine().1
    }
    /// The sines and cosines of several angles.
    #[must_use]
    fn sines_cosines<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        angles.map(Self::sine_cosine)
    }
}

impl<T: Real> Number for T {
    fn exactly(value: f64) -> Self {
        crate::real(value)
    }
    fn near(value: f64) -> Self {
        crate::real(value)
    }
    fn unknown() -> Self {
        crate::real(f64::NAN)
    }
    fn pi() -> Self {
        T::pi()
    }
    fn square(self) -> Self {
        self * self
    }
    fn abs(self) -> Self {
        ComplexField::abs(self)
    }
    fn sqrt(self) -> Self {
        T::sqrt(self)
    }
    fn exponential(self) -> Self {
        Real::exponential(self)
    }
    fn logarithm(self) -> Self {
        Real::logarithm(self)
    }
    fn sine_cosine(self) -> (Self, Self) {
        Real::sine_cosine(self)
    }
    fn tangent(self) -> Self {
        Real::tangent(self)
    }
    fn arcsine(self) -> Self {
        Real::arcsine(self)
    }
    fn arccosine(self) -> Self {
        Real::arccosine(self)
    }
    fn arctangent(self) -> Self {
        Real::arctangent(self)
    }
    fn arctangent2(self, x: Self) -> Self {
        Real::arctangent2(self, x)
    }
    fn hypotenuse(self, y: Self) -> Self {
        Real::hypotenuse(self, y)
    }
}
