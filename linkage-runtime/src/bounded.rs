//! Scalars that carry a bound of their error, such as `Rounded` of the crate `linkage-rounding`.
//!
//! A decision by values may replace a number: links that are in line within rounding error have the chord zero. Such a
//! scalar would take the new number for exact. [`instead`] gives it the bound of the old one and of their difference.

use nalgebra::is_convertible;

use crate::native::is_native;
use crate::scalar::{greatest, to_f64};
use crate::{Real, real};

/// Zero, off by at most one, for a scalar with a bound: the greatest number loses what is added to it.
#[inline]
fn one_lost<T: Real>() -> T {
    let greatest = greatest::<T>();
    (greatest + T::one()) - greatest
}

/// True if a scalar carries a bound of its error: a number that is not exact is then no double.
#[inline]
pub(crate) fn has_bound<T: Real>() -> bool {
    !is_native::<T>() && !is_convertible::<T, f64>(&one_lost())
}

/// Zero with the bound |number|, infinite if the number is not finite, for a scalar with a bound.
pub(crate) fn lost<T: Real>(number: T) -> T {
    // The sign of the zero is positive.
    if number.is_finite() { one_lost::<T>() * number.abs() } else { unknown(T::zero()) }
}

/// A number of whose error nothing is known, with this value, for a scalar with a bound.
pub(crate) fn unknown<T: Real>(value: T) -> T {
    // The divisor may be zero.
    value / (T::one() + lost(real(2.0)))
}

/// The value of a number without its error, for a scalar with a bound.
pub(crate) fn exact<T: Real>(number: T) -> T {
    /// The sign, the exponent and 12 bits: a scalar may take a longer fraction for a rounded decimal.
    const LEADING: u64 = !((1 << 40) - 1);
    let value = to_f64(number);
    let leading = |value: f64| f64::from_bits(value.to_bits() & LEADING);
    let mut sum = real::<T>(leading(value));
    let mut rest = value - leading(value);
    // 13 bits at a time; a remainder below the normal numbers is one part.
    while rest.abs() > 0.0 && rest.is_finite() {
        let part = if rest.is_normal() { leading(rest) } else { rest };
        sum += real(part);
        rest -= part;
    }
    sum
}

/// `value`, decided in place of the number `of`: for a scalar with a bound it is off by their difference and the error
/// of `of`.
#[inline]
pub(crate) fn instead<T: Real>(value: T, of: T) -> T {
    if has_bound::<T>() { exact(value) - lost(exact(value) - of) } else { value }
}

/// The angle of (x, y) where whole turns do not matter: for a scalar with a bound that of the opposite vector, which is not
/// near the cut, is taken.
pub(crate) fn angle_but_for_turns<T: Real>(y: T, x: T) -> T {
    let angle = y.arctangent2(x);
    if !has_bound::<T>() || x >= T::zero() {
        return angle;
    }
    let opposite = (-y).arctangent2(-x);
    let angle = exact(angle);
    // Both are rounded.
    angle - (opposite - exact(opposite)) - lost(T::default_epsilon() * angle)
}
