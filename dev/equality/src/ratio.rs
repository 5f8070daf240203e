//! Exact signed ratios; an overflow is an error.

use std::cmp::Ordering;

use crate::{Outcome, Reason};

/// `numerator / denominator` in lowest terms with a positive denominator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ratio {
    pub(super) numerator: i128,
    pub(super) denominator: i128,
}

impl Ratio {
    pub(super) const ZERO: Self = Self::integer(0);
    pub(super) const ONE: Self = Self::integer(1);

    pub(super) const fn integer(value: i128) -> Self {
        Self { numerator: value, denominator: 1 }
    }

    /// The denominator is not zero.
    pub(super) fn new(numerator: i128, denominator: i128) -> Outcome<Self> {
        let divisor = gcd(numerator, denominator)?;
        let (n, d) = (numerator / divisor, denominator / divisor);
        if d > 0 {
            return Ok(Self { numerator: n, denominator: d });
        }
        Ok(Self { numerator: exact(n.checked_neg())?, denominator: exact(d.checked_neg())? })
    }

    pub(super) fn is_zero(self) -> bool {
        self.numerator == 0
    }

    // a/b + c/d = (a (d/g) + c (b/g)) / (b (d/g)), g = gcd(b, d)
    pub(super) fn plus(self, other: Self) -> Outcome<Self> {
        let (Self { numerator: a, denominator: b }, Self { numerator: c, denominator: d }) = (self, other);
        if b == 1 && d == 1 {
            return Ok(Self::integer(exact(a.checked_add(c))?));
        }
        let shared = gcd(b, d)?;
        let (ours, theirs) = (exact(a.checked_mul(d / shared))?, exact(c.checked_mul(b / shared))?);
        Self::new(exact(ours.checked_add(theirs))?, exact(b.checked_mul(d / shared))?)
    }

    // a/b c/d, the common factors of a and d and of c and b taken out before they can overflow
    pub(super) fn times(self, other: Self) -> Outcome<Self> {
        let (Self { numerator: a, denominator: b }, Self { numerator: c, denominator: d }) = (self, other);
        if b == 1 && d == 1 {
            return Ok(Self::integer(exact(a.checked_mul(c))?));
        }
        let (left, right) = (gcd(a, d)?, gcd(c, b)?);
        let numerator = exact((a / left).checked_mul(c / right))?;
        Ok(Self { numerator, denominator: exact((b / right).checked_mul(d / left))? })
    }

    /// 1 / self, which is not zero.
    pub(super) fn inverse(self) -> Outcome<Self> {
        Self::new(self.denominator, self.numerator)
    }

    pub(super) fn power(self, exponent: u32) -> Outcome<Self> {
        let numerator = exact(self.numerator.checked_pow(exponent))?;
        Ok(Self { numerator, denominator: exact(self.denominator.checked_pow(exponent))? })
    }

    pub(super) fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

// By continued fractions: integer parts first, then the reciprocals of the remainders, in reverse order. There is no
// multiplication, so no overflow.
impl Ord for Ratio {
    fn cmp(&self, other: &Self) -> Ordering {
        let ([mut a, mut b], [mut c, mut d]) =
            ([self.numerator, self.denominator], [other.numerator, other.denominator]);
        if b == d {
            return a.cmp(&c);
        }
        loop {
            let order = a.div_euclid(b).cmp(&c.div_euclid(d));
            let (left, right) = (a.rem_euclid(b), c.rem_euclid(d));
            match (order, left, right) {
                (Ordering::Equal, 0, _) | (Ordering::Equal, _, 0) => return left.signum().cmp(&right.signum()),
                (Ordering::Equal, _, _) => ([a, b], [c, d]) = ([d, right], [b, left]),
                _ => return order,
            }
        }
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

fn exact<T>(value: Option<T>) -> Outcome<T> {
    value.ok_or(Reason::TooLarge.into())
}

/// The greatest common divisor, at least 1.
fn gcd(a: i128, b: i128) -> Outcome<i128> {
    let (mut a, mut b) = (a.unsigned_abs(), b.unsigned_abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    exact(i128::try_from(a.max(1)).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_and_arithmetic_are_those_of_the_numbers() {
        for (a, b, c, d) in [(1, 3, 1, 2), (-1, 3, -1, 2), (7, 3, 5, 2), (-7, 3, 1, 6), (2, 4, 1, 2), (3, 1, 8, 3)] {
            let (Ok(left), Ok(right)) = (Ratio::new(a, b), Ratio::new(c, d)) else { panic!("{a}/{b} and {c}/{d}") };
            assert_eq!(left.cmp(&right), (a * d).cmp(&(c * b)), "{a}/{b} and {c}/{d}");
            assert_eq!(left.plus(right).ok(), Ratio::new(a * d + c * b, b * d).ok());
            assert_eq!(left.times(right).ok(), Ratio::new(a * c, b * d).ok());
        }
    }

    #[test]
    fn overflow_is_an_error() {
        let large = Ratio::integer(i128::MAX);
        assert!(large.plus(Ratio::ONE).is_err() && large.times(large).is_err() && large.power(2).is_err());
        assert!(Ratio::new(1, i128::MIN).is_err());
        assert!(Ratio::integer(i128::MAX - 1) < large);
    }
}
