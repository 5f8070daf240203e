//! The traits that nalgebra requires of a real scalar.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use nalgebra::{ComplexField, RealField};
use num_traits::{FromPrimitive, Num, Signed};
use simba::scalar::SupersetOf;

use super::{DoubleDouble, functions};
use functions::{INVERSE_PI, LN_TEN, LN_TWO, ONE, PI, ZERO};

crate::__real_field! { scalar DoubleDouble, high, ZERO, ONE }

impl Num for DoubleDouble {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;

    /// Parses a double: digits beyond its precision are lost.
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self::from)
    }
}

impl Signed for DoubleDouble {
    fn abs(&self) -> Self {
        if RealField::is_sign_negative(self) { -*self } else { *self }
    }

    fn abs_sub(&self, other: &Self) -> Self {
        if self <= other { ZERO } else { *self - *other }
    }

    fn signum(&self) -> Self {
        self.high.signum().into()
    }

    crate::__real_field! { signed }
}

impl FromPrimitive for DoubleDouble {
    fn from_i64(n: i64) -> Option<Self> {
        // Each half of the bits is exactly a double.
        Some(Self::sum((n >> 32) as f64 * 4_294_967_296.0, (n & 0xffff_ffff) as f64))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Self::sum((n >> 32) as f64 * 4_294_967_296.0, (n & 0xffff_ffff) as f64))
    }

    fn from_f64(n: f64) -> Option<Self> {
        Some(n.into())
    }
}

impl AbsDiffEq for DoubleDouble {
    type Epsilon = Self;

    fn default_epsilon() -> Self {
        Self::EPSILON
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: Self) -> bool {
        Signed::abs(&(*self - *other)) <= epsilon
    }
}

impl RelativeEq for DoubleDouble {
    fn default_max_relative() -> Self {
        Self::EPSILON
    }

    fn relative_eq(&self, other: &Self, epsilon: Self, max_relative: Self) -> bool {
        let size = RealField::max(Signed::abs(self), Signed::abs(other));
        self == other || self.abs_diff_eq(other, RealField::max(epsilon, size * max_relative))
    }
}

impl UlpsEq for DoubleDouble {
    fn default_max_ulps() -> u32 {
        4
    }

    fn ulps_eq(&self, other: &Self, epsilon: Self, max_ulps: u32) -> bool {
        self.relative_eq(other, epsilon, Self::EPSILON * f64::from(max_ulps).into())
    }
}

impl SupersetOf<f64> for DoubleDouble {
    fn is_in_subset(&self) -> bool {
        true
    }

    fn to_subset_unchecked(&self) -> f64 {
        self.high
    }

    fn from_subset(element: &f64) -> Self {
        (*element).into()
    }
}

impl SupersetOf<f32> for DoubleDouble {
    fn is_in_subset(&self) -> bool {
        true
    }

    fn to_subset_unchecked(&self) -> f32 {
        self.high as f32
    }

    fn from_subset(element: &f32) -> Self {
        f64::from(*element).into()
    }
}

macro_rules! from_functions {
    ($($name:ident)*) => {$(
        fn $name(self) -> Self {
            functions::$name(self)
        }
    )*};
}

impl ComplexField for DoubleDouble {
    type RealField = Self;

    crate::__real_field! { complex ZERO, ONE }

    from_functions! { asin acos exp exp_m1 ln ln_1p cbrt sinh tanh asinh floor }

    fn argument(self) -> Self {
        if self.high < 0.0 { PI } else { ZERO }
    }

    fn ceil(self) -> Self {
        -functions::floor(-self)
    }

    /// Rounds halves away from zero.
    fn round(self) -> Self {
        (self + RealField::copysign(Self::from(0.5), self)).trunc()
    }

    fn trunc(self) -> Self {
        if self.high < 0.0 { self.ceil() } else { functions::floor(self) }
    }

    #[inline]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }

    fn hypot(self, other: Self) -> Self {
        functions::hypot(self, other)
    }

    fn sin(self) -> Self {
        functions::sin_cos(self).0
    }

    fn cos(self) -> Self {
        functions::sin_cos(self).1
    }

    fn sin_cos(self) -> (Self, Self) {
        functions::sin_cos(self)
    }

    fn tan(self) -> Self {
        let (sine, cosine) = functions::sin_cos(self);
        sine / cosine
    }

    fn atan(self) -> Self {
        functions::atan2(self, ONE)
    }

    fn cosh(self) -> Self {
        (functions::exp(self) + functions::exp(-self)) * 0.5.into()
    }

    fn acosh(self) -> Self {
        functions::ln_1p((self - ONE) + ((self - ONE) * (self + ONE)).root())
    }

    fn atanh(self) -> Self {
        functions::ln_1p((self + self) / (ONE - self)) * 0.5.into()
    }

    fn log(self, base: Self) -> Self {
        functions::ln(self) / functions::ln(base)
    }

    fn log2(self) -> Self {
        functions::ln(self) / LN_TWO
    }

    fn log10(self) -> Self {
        functions::ln(self) / LN_TEN
    }

    fn exp2(self) -> Self {
        functions::powf(2.0.into(), self)
    }

    fn powi(self, n: i32) -> Self {
        functions::powi(self, n)
    }

    fn powf(self, n: Self) -> Self {
        functions::powf(self, n)
    }

    fn powc(self, n: Self) -> Self {
        functions::powf(self, n)
    }

    fn is_finite(&self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    fn try_sqrt(self) -> Option<Self> {
        (self.high >= 0.0).then(|| self.root())
    }
}

macro_rules! constants {
    ($($name:ident $value:expr;)*) => {$(
        fn $name() -> Self {
            $value
        }
    )*};
}

impl RealField for DoubleDouble {
    fn is_sign_positive(&self) -> bool {
        self.high.is_sign_positive()
    }

    fn is_sign_negative(&self) -> bool {
        self.high.is_sign_negative()
    }

    fn copysign(self, sign: Self) -> Self {
        if self.high.is_sign_negative() == sign.high.is_sign_negative() { self } else { -self }
    }

    fn max(self, other: Self) -> Self {
        if self >= other || other.high.is_nan() { self } else { other }
    }

    fn min(self, other: Self) -> Self {
        if self <= other || other.high.is_nan() { self } else { other }
    }

    fn clamp(self, min: Self, max: Self) -> Self {
        if self < min {
            min
        } else if self > max {
            max
        } else {
            self
        }
    }

    fn atan2(self, other: Self) -> Self {
        functions::atan2(self, other)
    }

    crate::__real_field! { range }

    constants! {
        pi PI;
        two_pi PI + PI;
        frac_pi_2 PI * 0.5.into();
        frac_pi_3 PI / 3.0.into();
        frac_pi_4 PI * 0.25.into();
        frac_pi_6 PI / 6.0.into();
        frac_pi_8 PI * 0.125.into();
        frac_1_pi INVERSE_PI;
        frac_2_pi INVERSE_PI + INVERSE_PI;
        frac_2_sqrt_pi functions::TWO_BY_ROOT_PI;
        e functions::E;
        log2_e ONE / LN_TWO;
        log10_e ONE / LN_TEN;
        ln_2 LN_TWO;
        ln_10 LN_TEN;
    }
}
