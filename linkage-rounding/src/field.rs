//! The traits that nalgebra requires of a real scalar.

use core::f64::consts;

use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use nalgebra::{ComplexField, RealField};
use num_traits::{FromPrimitive, Num, One, Signed, Zero};
use simba::scalar::SupersetOf;

use crate::Rounded;
use crate::functions;
use crate::residual::half_ulp;
use crate::rules::{one_of, stepped};

impl Rounded {
    /// A double that may be the rounded value of a constant, see the type.
    fn constant(value: f64) -> Self {
        /// 2^53: below it all whole numbers are doubles.
        const WHOLE: f64 = 9_007_199_254_740_992.0;
        let is_whole = value.abs() <= WHOLE && value == ComplexField::trunc(value);
        let is_exact = is_whole || is_dyadic(value);
        // Infinity and NaN have no rounding error.
        if is_exact || !value.is_finite() { Self::from(value) } else { Self::nearest(value) }
    }

    /// True if the exact number may be zero or have the other sign.
    fn may_have_either_sign(self) -> bool {
        self.error > 0.0 && self.value.abs() <= self.error
    }

    /// The double nearest to a number.
    fn nearest(value: f64) -> Self {
        Self::with_error(value, half_ulp(value))
    }
}

/// True if the lowest 20 of the 53 bits are zero, for a rounded constant a chance of one in a million, and no shorter decimal
/// number has this double: a fraction m / 2^k, where m is odd, has the k decimals of m 5^k, here at most 17 digits. Also
/// if the lowest 40 bits are, as of powers of two: a chance of one in 1e12.
fn is_dyadic(value: f64) -> bool {
    const SHORT: u32 = 20;
    const VERY_SHORT: u32 = 40;
    /// 2^52, the bit of a normal double that is not stored.
    const LEADING: u64 = 1 << 52;
    /// 5^25 has 18 digits.
    const MOST_FIVES: u32 = 24;
    const DIGITS_17: u64 = 100_000_000_000_000_000;
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32 - 1075;
    let mantissa = bits & (LEADING - 1) | LEADING;
    let zeros = mantissa.trailing_zeros();
    let decimals = u32::try_from(-(exponent + zeros as i32)).unwrap_or(0);
    let digits = || (mantissa >> zeros).checked_mul(5_u64.pow(decimals));
    let has_few_digits = || decimals <= MOST_FIVES && digits().is_some_and(|digits| digits < DIGITS_17);
    zeros >= VERY_SHORT || (zeros >= SHORT && has_few_digits())
}

linkage_double::__real_field! { scalar Rounded, value, Self::from(0.0), Self::from(1.0) }

impl Num for Rounded {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;

    /// Parses a double as a constant.
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Self::constant)
    }
}

impl Signed for Rounded {
    /// ||X| - |x|| <= |X - x|
    fn abs(&self) -> Self {
        Self { value: self.value.abs(), error: self.error }
    }

    fn abs_sub(&self, other: &Self) -> Self {
        // max(X - Y, 0)
        let difference = *self - *other;
        Self { value: if self <= other { 0.0 } else { difference.value }, error: difference.error }
    }

    fn signum(&self) -> Self {
        stepped(*self, |value| value.signum())
    }

    linkage_double::__real_field! { signed }
}

impl FromPrimitive for Rounded {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Self::constant(n as f64))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Self::constant(n as f64))
    }

    fn from_f64(n: f64) -> Option<Self> {
        Some(Self::constant(n))
    }
}

impl AbsDiffEq for Rounded {
    type Epsilon = Self;

    fn default_epsilon() -> Self {
        Self::from(f64::EPSILON)
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: Self) -> bool {
        self.value.abs_diff_eq(&other.value, epsilon.value)
    }
}

impl RelativeEq for Rounded {
    fn default_max_relative() -> Self {
        Self::from(f64::EPSILON)
    }

    fn relative_eq(&self, other: &Self, epsilon: Self, max_relative: Self) -> bool {
        self.value.relative_eq(&other.value, epsilon.value, max_relative.value)
    }
}

impl UlpsEq for Rounded {
    fn default_max_ulps() -> u32 {
        f64::default_max_ulps()
    }

    fn ulps_eq(&self, other: &Self, epsilon: Self, max_ulps: u32) -> bool {
        self.value.ulps_eq(&other.value, epsilon.value, max_ulps)
    }
}

impl SupersetOf<f64> for Rounded {
    /// True if the number is the double.
    fn is_in_subset(&self) -> bool {
        self.error == 0.0
    }

    fn to_subset_unchecked(&self) -> f64 {
        self.value
    }

    fn from_subset(element: &f64) -> Self {
        Self::constant(*element)
    }
}

impl SupersetOf<f32> for Rounded {
    fn is_in_subset(&self) -> bool {
        self.error == 0.0
    }

    fn to_subset_unchecked(&self) -> f32 {
        self.value as f32
    }

    /// An `f32` has fewer digits than a constant that was rounded to a double.
    fn from_subset(element: &f32) -> Self {
        Self::from(f64::from(*element))
    }
}

macro_rules! from_functions {
    ($($name:ident)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            functions::$name(self)
        }
    )*};
}

/// Functions of which no error is known.
macro_rules! without_bound {
    ($($name:ident)*) => {$(
        fn $name(self) -> Self {
            Self::unknown(ComplexField::$name(self.value))
        }
    )*};
}

macro_rules! to_whole_numbers {
    ($($name:ident)*) => {$(
        #[inline]
        fn $name(self) -> Self {
            stepped(self, ComplexField::$name)
        }
    )*};
}

impl ComplexField for Rounded {
    type RealField = Self;

    linkage_double::__real_field! { complex Self::zero(), Self::one() }

    from_functions! { tan asin acos atan exp exp2 exp_m1 ln ln_1p log2 }

    without_bound! { log10 sinh cosh tanh asinh acosh atanh cbrt }

    to_whole_numbers! { floor ceil round trunc }

    fn argument(self) -> Self {
        let argument = if self.value >= 0.0 { Self::zero() } else { Self::pi() };
        if self.may_have_either_sign() { Self::bounded(argument.value, consts::PI) } else { argument }
    }

    #[inline]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self.fused(a, b)
    }

    fn hypot(self, other: Self) -> Self {
        functions::hypot(self, other)
    }

    fn sin(self) -> Self {
        functions::sine_cosine(self).0
    }

    fn cos(self) -> Self {
        functions::sine_cosine(self).1
    }

    fn sin_cos(self) -> (Self, Self) {
        functions::sine_cosine(self)
    }

    fn log(self, base: Self) -> Self {
        functions::log(self, base)
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

    /// True if the value is finite, as in `f64`; the bound may be infinite.
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }

    fn try_sqrt(self) -> Option<Self> {
        (self.value >= 0.0).then(|| self.root())
    }
}

macro_rules! constants {
    ($($name:ident $value:ident;)*) => {$(
        fn $name() -> Self {
            Self::nearest(consts::$value)
        }
    )*};
}

impl RealField for Rounded {
    fn is_sign_positive(&self) -> bool {
        self.value.is_sign_positive()
    }

    fn is_sign_negative(&self) -> bool {
        self.value.is_sign_negative()
    }

    fn copysign(self, sign: Self) -> Self {
        let moved = if sign.may_have_either_sign() { 2.0 * self.value.abs() } else { 0.0 };
        Self::bounded(self.value.copysign(sign.value), self.error + moved)
    }

    fn max(self, other: Self) -> Self {
        one_of(self, other, RealField::max(self.value, other.value))
    }

    fn min(self, other: Self) -> Self {
        one_of(self, other, RealField::min(self.value, other.value))
    }

    fn clamp(self, min: Self, max: Self) -> Self {
        let value = RealField::clamp(self.value, min.value, max.value);
        one_of(one_of(self, min, value), max, value)
    }

    fn atan2(self, other: Self) -> Self {
        functions::atan2(self, other)
    }

    linkage_double::__real_field! { range }

    constants! {
        pi PI;
        two_pi TAU;
        frac_pi_2 FRAC_PI_2;
        frac_pi_3 FRAC_PI_3;
        frac_pi_4 FRAC_PI_4;
        frac_pi_6 FRAC_PI_6;
        frac_pi_8 FRAC_PI_8;
        frac_1_pi FRAC_1_PI;
        frac_2_pi FRAC_2_PI;
        frac_2_sqrt_pi FRAC_2_SQRT_PI;
        e E;
        log2_e LOG2_E;
        log10_e LOG10_E;
        ln_2 LN_2;
        ln_10 LN_10;
    }
}
