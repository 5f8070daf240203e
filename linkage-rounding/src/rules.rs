//! The bounds of arithmetic: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3, but
//! with the rounding error of the operation itself in place of its bound, so that an exact operation adds nothing.
//!
//! x and y are the doubles, X and Y the exact numbers, e1 >= |X - x| and e2 >= |Y - y|; z is the double that the operation
//! gives, Z the exact result, and r the rounding error of `residual`.

use nalgebra::{ComplexField, RealField};

use crate::Rounded;
use crate::residual::{TINY, UNIT, half_ulp, of_product, of_quotient, of_root, of_sum};

/// 1 + 2^-49: covers the rounding errors of a bound, which is a sum of a few positive terms. Each of at most eight
/// operations makes it smaller by at most 2^-53 of itself.
const MARGIN: f64 = 1.0 + 16.0 * UNIT;

/// The product of two bounds, not smaller by underflow.
#[inline]
pub(crate) fn times(a: f64, b: f64) -> f64 {
    let product = a * b;
    if a > 0.0 && b > 0.0 { product + TINY } else { product }
}

impl Rounded {
    /// A result and the sum of the terms of its bound.
    #[inline]
    pub(crate) fn bounded(value: f64, terms: f64) -> Self {
        Self::with_error(value, terms * MARGIN)
    }

    /// |Z - z| <= e1 + e2 + |x + y - z|
    #[inline]
    pub(crate) fn plus(self, other: Self) -> Self {
        let value = self.value + other.value;
        Self::bounded(value, self.error + other.error + of_sum(self.value, other.value, value))
    }

    /// X Y - x y = x (Y - y) + y (X - x) + (X - x) (Y - y), hence |Z - z| <= |x| e2 + |y| e1 + e1 e2 + |x y - z|
    #[inline]
    pub(crate) fn times(self, other: Self) -> Self {
        let value = self.value * other.value;
        let first = times(self.value.abs(), other.error) + times(other.value.abs(), self.error);
        let rounding = of_product(self.value, other.value, value);
        Self::bounded(value, first + times(self.error, other.error) + rounding)
    }

    /// X / Y - z = (X - z Y) / Y and X - z Y = (x - z y) + (X - x) - z (Y - y), hence
    /// |Z - z| <= (|x - z y| + e1 + |z| e2) / (|y| - e2), if Y cannot be zero
    #[inline]
    pub(crate) fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        let least = other.value.abs() - other.error;
        if least > 0.0 {
            let remainder = of_quotient(self.value, other.value, value);
            let above = remainder + self.error + times(value.abs(), other.error);
            let below = above / least;
            // A quotient that underflows loses up to half the smallest double.
            Self::bounded(value, if above > 0.0 { below + TINY } else { below })
        } else {
            Self::unknown(value)
        }
    }

    /// sqrt(X) - z = (X - z^2) / (sqrt(X) + z), hence |Z - z| <= (e1 + |x - z^2|) / (sqrt(x - e1) + z). If e1 > x, by
    /// |sqrt(X) - sqrt(x)| <= sqrt(|X - x|): |Z - z| <= sqrt(e1) + u z
    #[inline]
    pub(crate) fn root(self) -> Self {
        let value = ComplexField::sqrt(self.value);
        if self.value == 0.0 && self.error == 0.0 {
            return Self::from(value);
        }
        let least = self.value - self.error;
        if least > 0.0 {
            let above = self.error + of_root(self.value, value);
            Self::bounded(value, above / (ComplexField::sqrt(least) + value))
        } else {
            Self::bounded(value, ComplexField::sqrt(self.error) + UNIT * value)
        }
    }

    /// The fused product and sum, rounded once: |Z - z| <= |x| e2 + |y| e1 + e1 e2 + e3 + u |z|
    pub(crate) fn fused(self, factor: Self, term: Self) -> Self {
        let value = ComplexField::mul_add(self.value, factor.value, term.value);
        let first = times(self.value.abs(), factor.error) + times(factor.value.abs(), self.error);
        let second = times(self.error, factor.error) + term.error;
        Self::bounded(value, first + second + half_ulp(value))
    }

    /// X - K Y, where the remainder of doubles x - k y is exact: |Z - z| <= e1 + |K| e2 + |K - k| |y|, and both whole numbers
    /// are in the interval of that of the quotient.
    pub(crate) fn remainder(self, other: Self) -> Self {
        let value = self.value % other.value;
        if self.error == 0.0 && other.error == 0.0 && value.is_finite() {
            return Self::from(value);
        }
        let count = stepped(self.over(other), ComplexField::trunc);
        let moved = times(count.value.abs() + count.error, other.error) + times(2.0 * count.error, other.value.abs());
        Self::bounded(value, self.error + moved)
    }
}

/// A function that does not decrease and jumps, such as a rounding to a whole number: the exact result is between those
/// of the ends of the argument's interval.
pub(crate) fn stepped(x: Rounded, of: impl Fn(f64) -> f64) -> Rounded {
    let value = of(x.value);
    if x.error == 0.0 {
        return Rounded::from(value);
    }
    // An end that is rounded is moved outwards.
    let [low, high] = [x.value - x.error, x.value + x.error];
    let low = if of_sum(x.value, -x.error, low) == 0.0 { low } else { low.next_down() };
    let high = if of_sum(x.value, x.error, high) == 0.0 { high } else { high.next_up() };
    let [below, above] = [value - of(low), of(high) - value];
    // Also unknown if an end is infinite or NaN.
    Rounded::bounded(value, if below >= above { below } else { above })
}

/// The larger or smaller of two numbers is off by at most the larger error.
pub(crate) fn one_of(x: Rounded, y: Rounded, value: f64) -> Rounded {
    Rounded::with_error(value, RealField::max(x.error, y.error))
}
