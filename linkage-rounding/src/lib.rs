//! Doubles that carry a bound of their own rounding error: running error analysis.
//!
//! Wherever a function is generic over its scalar, [`Rounded`] in place of `f64` tells how many ulps each result can be
//! off, for these arguments. N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3; the
//! rounding error of each sum, product, quotient and square root enters as it is, not as its bound, so that exact
//! operations add nothing.
//!
//! | function | relative error in u = 2^-53 |
//! |---|---|
//! | sum, difference, product, quotient, square root | computed; they round to nearest, as IEEE 754 requires |
//! | sine and cosine up to 1e5 | 1.29, proved for `linkage_runtime` |
//! | `atan2` of numbers that are not extreme | 1.25, proved for `linkage_runtime` |
//! | `hypot` | computed, at most 2, proved |
//! | exp, ln, powers, tan, asin, acos, atan; sine, cosine and `atan2` of other arguments | 2, one ulp: assumed of `libm` and, for powers, of the platform |
//! | hyperbolic functions, cbrt, log10 | unknown |

#![cfg_attr(not(feature = "std"), no_std)]
// The crate is empty without elementary functions; `linkage` reports the missing feature.
#![cfg(any(feature = "std", feature = "libm"))]
#![warn(missing_docs)]

mod field;
mod functions;
mod residual;
mod rules;
#[cfg(feature = "serde")]
mod serialised;

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign};

/// A double and an upper bound of its distance from the exact result. It is a scalar of nalgebra, so that every
/// mechanism can compute with it: `FourBar<Rounded>`. The values are those of `f64`, bit for bit.
///
/// The exact result is that of the formulas, with the arguments as they are stored. `Rounded::from` takes a double as
/// exact; [`with_error`](Self::with_error) takes a measured one.
///
/// ```
/// use linkage_rounding::Rounded;
///
/// let third = Rounded::from(1.0) / Rounded::from(3.0);
/// assert_eq!(third.value(), 1.0 / 3.0);
/// assert!(third.error() > 1.8e-17 && third.error() < 1.9e-17);
/// // Cancellation: the difference is exact, its arguments are not.
/// let difference = third - Rounded::from(0.333_333);
/// assert!(difference.ulps() > 1e5);
/// ```
///
/// - Comparisons are decided by the value, as in `f64`. The bound is that of the formulas that were computed; it does not
///   say whether the exact numbers would have been compared otherwise. Where a function jumps, the bound has both sides:
///   a sign, a whole number, or an angle by `atan2`, which may be off by a turn if the exact numbers may lie across the
///   negative x axis.
/// - A number is a member of the subset of doubles (`nalgebra::try_convert`) only if its bound is zero. By this the
///   functions of a mechanism see that a scalar carries bounds: the chord of links in line, zero by comparison, keeps the
///   error of the difference that was compared; a position by Newton's method has the bound of one more step; a result
///   that `f64` computes in twice the precision has these bits, and is off by its difference from the plain result and by
///   the bound of that.
/// - A constant in the text of a mechanism, such as the 0.1 of `0.1 * l2`, is rounded to a double. Each double that is
///   converted by `nalgebra::convert` counts as such a constant, with an error of half an ulp, but for whole numbers up
///   to 2^53 and for fractions of at most 33 bits and 17 decimal digits, such as 0.375, or of at most 13 bits, such as
///   powers of two, which are exact.
/// - Where an algorithm compensates its rounding errors, the bound does not see that they cancel and is far too large, as
///   that of results in twice the precision.
/// - A bound that is not finite means that nothing is known, for instance after a division by a number that may be
///   zero. A user function that computes in `f64` returns [`unknown`](Self::unknown), or its own bound.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rounded {
    /// The result in doubles.
    value: f64,
    /// The bound: not negative, infinite if unknown.
    error: f64,
}

impl Rounded {
    /// A number that is off by at most `error`; a bound that is negative or NaN counts as unknown.
    #[inline]
    #[must_use]
    pub const fn with_error(value: f64, error: f64) -> Self {
        Self { value, error: if error >= 0.0 { error } else { f64::INFINITY } }
    }

    /// A number of whose error nothing is known.
    #[inline]
    #[must_use]
    pub const fn unknown(value: f64) -> Self {
        Self { value, error: f64::INFINITY }
    }

    /// The double.
    #[inline]
    #[must_use]
    pub const fn value(self) -> f64 {
        self.value
    }

    /// A bound of the absolute error; infinite if unknown.
    #[inline]
    #[must_use]
    pub const fn error(self) -> f64 {
        self.error
    }

    /// The bound in units in the last place of the value; infinite if the value is not finite.
    #[must_use]
    pub fn ulps(self) -> f64 {
        let size = self.value.abs();
        if !size.is_finite() {
            return f64::INFINITY;
        }
        // The neighbours of a double; only the largest has none above.
        let [bits, above] = [size.to_bits(), size.to_bits() + 1];
        let ulp = if size < f64::MAX { f64::from_bits(above) - size } else { size - f64::from_bits(bits - 1) };
        self.error / ulp
    }
}

/// The double, exactly.
impl From<f64> for Rounded {
    #[inline]
    fn from(value: f64) -> Self {
        Self::with_error(value, 0.0)
    }
}

/// The values are compared.
impl PartialEq for Rounded {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// The values are compared.
impl PartialOrd for Rounded {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

/// Writes the value and the bound.
impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ± {:.1e}", self.value, self.error)
    }
}

impl Neg for Rounded {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, error: self.error }
    }
}

macro_rules! operators {
    ($($Operator:ident $operator:ident, $Assign:ident $assign:ident: $of:expr;)*) => {$(
        impl $Operator for Rounded {
            type Output = Self;

            #[inline]
            fn $operator(self, other: Self) -> Self {
                $of(self, other)
            }
        }

        impl $Assign for Rounded {
            #[inline]
            fn $assign(&mut self, other: Self) {
                *self = $of(*self, other);
            }
        }
    )*};
}

operators! {
    Add add, AddAssign add_assign: Rounded::plus;
    Sub sub, SubAssign sub_assign: |a: Rounded, b: Rounded| a.plus(-b);
    Mul mul, MulAssign mul_assign: Rounded::times;
    Div div, DivAssign div_assign: Rounded::over;
    Rem rem, RemAssign rem_assign: Rounded::remainder;
}
