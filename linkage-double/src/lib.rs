//! Numbers of about 31 digits: the unevaluated sum of two doubles.
//!
//! T. J. Dekker, "A floating-point technique for extending the available precision" (1971); sum, product and quotient
//! as in M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic" (2017). No operation needs a fused multiply-add: every target computes the same bits.
//!
//! The type is a scalar of nalgebra, and its functions are accurate to the last bit or two; no other maintained crate
//! of this kind has both.

#![cfg_attr(not(feature = "std"), no_std)]
// The crate is empty without elementary functions; `linkage` reports the missing feature.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

mod field;
mod functions;
mod real_field;

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign};

use nalgebra::ComplexField;

/// A real number as the sum of two doubles, accurate to 31 digits. It is a scalar of nalgebra, so that every mechanism
/// can compute with it: `FourBar<DoubleDouble>`.
///
/// Numbers up to 2^-27 times the largest `f64` can be multiplied; below 1e-290 digits are lost, because the low part
/// underflows. A result beyond the range is infinite or NaN, never wrong. Constants in the text of a mechanism, such as
/// the 0.1 of `0.1 * l2`, are rounded to doubles.
///
/// ```
/// use linkage_double::DoubleDouble;
///
/// let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
/// assert_eq!(third.high(), 1.0 / 3.0);
/// assert!((third.low() - 1.850_371_707_708_594e-17).abs() < 1e-32);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Parts"))]
pub struct DoubleDouble {
    /// The double nearest to the number.
    high: f64,
    /// The rest, at most half an ulp of `high`.
    low: f64,
}

/// Two doubles that have been read, not yet checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Parts {
    high: f64,
    low: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for DoubleDouble {
    type Error = &'static str;

    fn try_from(Parts { high, low }: Parts) -> Result<Self, Self::Error> {
        let is_nearest = !high.is_finite() || high + low == high;
        if is_nearest { Ok(Self { high, low }) } else { Err("`high` is not the double nearest to `high + low`") }
    }
}

impl DoubleDouble {
    /// The unit in the last place of 1: 2^-104.
    pub const EPSILON: Self = Self { high: f64::from_bits(0x3970_0000_0000_0000), low: 0.0 };

    /// The sum of two doubles, exactly.
    #[must_use]
    pub const fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The product of two doubles, exactly.
    #[must_use]
    pub const fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let ((a, c), (b, d)) = (halves(a), halves(b));
        Self { high, low: ((a * b - high) + a * d + c * b) + c * d }
    }

    /// The nearest double.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// The remainder, the number less its nearest double.
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// The sum of two doubles of which the first is the larger in magnitude, exactly.
    const fn ordered(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    const fn plus(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let sum = Self::ordered(high.high, high.low + low.high);
        Self::ordered(sum.high, sum.low + low.low)
    }

    const fn times(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::ordered(product.high, product.low + (self.high * other.low + self.low * other.high))
    }

    /// The quotient by long division, in three doubles.
    const fn over(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self.plus(other.times(Self { high: -first, low: -0.0 }));
        let second = rest.high / other.high;
        let rest = rest.plus(other.times(Self { high: -second, low: -0.0 }));
        Self::ordered(first, second).plus(Self { high: rest.high / other.high, low: 0.0 })
    }

    /// The square root: one step of Heron's method from the root of the nearest double.
    fn root(self) -> Self {
        let root = ComplexField::sqrt(self.high);
        if root == 0.0 || !ComplexField::is_finite(&root) {
            return Self::from(root);
        }
        let rest = self - Self::product(root, root);
        Self::ordered(root, rest.high / (2.0 * root))
    }
}

/// Splits a double into its upper 26 bits and the rest, by a product with 2^27 + 1: products of such halves are exact.
const fn halves(a: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

/// Writes both parts, each with as many digits as identify it.
impl fmt::Display for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:+e}", self.high, self.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

macro_rules! operators {
    ($($Operator:ident $operator:ident, $Assign:ident $assign:ident: $of:expr;)*) => {$(
        impl $Operator for DoubleDouble {
            type Output = Self;

            #[inline]
            fn $operator(self, other: Self) -> Self {
                $of(self, other)
            }
        }

        impl $Assign for DoubleDouble {
            #[inline]
            fn $assign(&mut self, other: Self) {
                *self = $of(*self, other);
            }
        }
    )*};
}

operators! {
    Add add, AddAssign add_assign: DoubleDouble::plus;
    Sub sub, SubAssign sub_assign: |a: DoubleDouble, b: DoubleDouble| a.plus(-b);
    Mul mul, MulAssign mul_assign: DoubleDouble::times;
    Div div, DivAssign div_assign: DoubleDouble::over;
    Rem rem, RemAssign rem_assign: |a: DoubleDouble, b: DoubleDouble| a - (a / b).trunc() * b;
}
