//! Ratios of integers, exactly: factors of angles, such as a ratio of numbers of teeth.

use linkage_runtime::Number;

use crate::Interval;

/// n / d 2^e, where n and d are odd, d is positive and they have no common factor; zero is 0 / 1 2^0.
///
/// Every double is one, and another unit of length changes the exponent alone. A result whose n or d has more than 127
/// bits is `None`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Ratio {
    numerator: i128,
    denominator: i128,
    exponent: i32,
}

impl Ratio {
    pub(crate) const ZERO: Self = Self { numerator: 0, denominator: 1, exponent: 0 };
    pub(crate) const ONE: Self = Self { numerator: 1, denominator: 1, exponent: 0 };

    /// The value of a double; `None` for NaN and infinity.
    pub(crate) fn of(value: f64) -> Option<Self> {
        /// A double is its fraction of 52 bits, with a leading 1 unless it is subnormal, times 2^(exponent - 1075).
        const FRACTION: u64 = (1 << 52) - 1;
        if !value.is_finite() {
            return None;
        }
        let (bits, biased) = (value.to_bits() & FRACTION, (value.to_bits() >> 52 & 0x7ff) as i32);
        let (fraction, exponent) = if biased == 0 { (bits, -1074) } else { (bits | (FRACTION + 1), biased - 1075) };
        let magnitude = i128::from(fraction);
        Self::reduced(if value < 0.0 { -magnitude } else { magnitude }, 1, exponent)
    }

    pub(crate) fn of_integer(value: i64) -> Option<Self> {
        Self::reduced(value.into(), 1, 0)
    }

    pub(crate) fn is_zero(self) -> bool {
        self.numerator == 0
    }

    pub(crate) fn is_integer(self) -> bool {
        self.denominator == 1 && self.exponent >= 0
    }

    fn reduced(numerator: i128, denominator: i128, exponent: i32) -> Option<Self> {
        if numerator == 0 {
            return Some(Self::ZERO);
        }
        let divisor = common_divisor(numerator, denominator);
        let (numerator, denominator) = (numerator.checked_div(divisor)?, denominator.checked_div(divisor)?);
        let (numerator, denominator) = if denominator < 0 {
            (numerator.checked_neg()?, denominator.checked_neg()?)
        } else {
            (numerator, denominator)
        };
        let [up, down] = [numerator, denominator].map(i128::trailing_zeros);
        let exponent = exponent.checked_add(i32::try_from(up).ok()?)?.checked_sub(i32::try_from(down).ok()?)?;
        Some(Self { numerator: numerator >> up, denominator: denominator >> down, exponent })
    }

    pub(crate) fn plus(self, other: Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(if self.is_zero() { other } else { self });
        }
        let exponent = self.exponent.min(other.exponent);
        let shifted = |ratio: Self| {
            let factor = 1_i128.checked_shl(u32::try_from(ratio.exponent.checked_sub(exponent)?).ok()?)?;
            // 2^127 is negative.
            ratio.numerator.checked_mul(factor).filter(|_| factor > 0)
        };
        let above = shifted(self)?.checked_mul(other.denominator)?;
        let numerator = above.checked_add(shifted(other)?.checked_mul(self.denominator)?)?;
        Self::reduced(numerator, self.denominator.checked_mul(other.denominator)?, exponent)
    }

    pub(crate) fn times(self, other: Self) -> Option<Self> {
        // Crosswise they may have common factors.
        let [one, two] =
            [common_divisor(self.numerator, other.denominator), common_divisor(other.numerator, self.denominator)];
        let numerator = (self.numerator / one).checked_mul(other.numerator / two)?;
        let denominator = (self.denominator / two).checked_mul(other.denominator / one)?;
        Self::reduced(numerator, denominator, self.exponent.checked_add(other.exponent)?)
    }

    /// 1 / self; `None` of zero.
    pub(crate) fn inverse(self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        Self::reduced(self.denominator, self.numerator, self.exponent.checked_neg()?)
    }

    /// The largest ratio of which both are whole multiples, where neither is zero.
    pub(crate) fn common_part(self, other: Self) -> Option<Self> {
        let numerator = common_divisor(self.numerator, other.numerator);
        let shared = common_divisor(self.denominator, other.denominator);
        let denominator = (self.denominator / shared).checked_mul(other.denominator)?;
        Self::reduced(numerator, denominator, self.exponent.min(other.exponent))
    }

    pub(crate) fn magnitude(self) -> Self {
        if self.numerator < 0 { self.negative() } else { self }
    }

    /// An interval that contains it.
    pub(crate) fn enclosure(self) -> Interval {
        let is_double = |integer: i128| integer.unsigned_abs() < 1 << 53;
        let of = |integer: i128| {
            if is_double(integer) { Interval::exactly(integer as f64) } else { Interval::near(integer as f64) }
        };
        // A power that is no double leaves nothing known.
        let power = 2_f64.powi(self.exponent);
        let power = if power > 0.0 { Interval::exactly(power) } else { Interval::ENTIRE };
        of(self.numerator) / of(self.denominator) * power
    }

    pub(crate) fn negative(self) -> Self {
        // The magnitude of a numerator is at most 2^127 - 1: it is odd.
        Self { numerator: self.numerator.wrapping_neg(), ..self }
    }
}

/// The greatest common divisor, which is positive; 1 with zero, which has no other use here.
fn common_divisor(one: i128, other: i128) -> i128 {
    let (mut divisor, mut rest) = (one.unsigned_abs(), other.unsigned_abs());
    if divisor == 0 || rest == 0 {
        return 1;
    }
    while rest != 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    i128::try_from(divisor).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: f64, denominator: f64) -> Ratio {
        Ratio::of(numerator).unwrap().times(Ratio::of(denominator).unwrap().inverse().unwrap()).unwrap()
    }

    #[test]
    fn sums_and_products_are_exact() {
        let third = ratio(1.0, 3.0);
        let sum = third.plus(third).and_then(|two| two.plus(third));
        assert_eq!(sum, Some(Ratio::ONE));
        assert_eq!(ratio(-7.0, 6.0).times(ratio(6.0, -7.0)), Some(Ratio::ONE));
        assert_eq!(ratio(5.0, 12.0).plus(ratio(-5.0, 12.0)), Some(Ratio::ZERO));
        // 0.1 + 0.2 is not the double 0.3.
        let sum = Ratio::of(0.1).unwrap().plus(Ratio::of(0.2).unwrap());
        assert!(sum.is_some() && sum != Ratio::of(0.3));
    }

    #[test]
    fn common_parts() {
        for (one, other, part) in [
            ([4.0, 1.0], [6.0, 1.0], [2.0, 1.0]),
            ([1.0, 3.0], [1.0, 2.0], [1.0, 6.0]),
            ([-3.0, 10.0], [1.0, 5.0], [1.0, 10.0]),
            ([2.0, 3.0], [2.0, 3.0], [2.0, 3.0]),
        ] {
            let [one, other, part] = [one, other, part].map(|[above, below]| ratio(above, below));
            assert_eq!(one.common_part(other), Some(part));
            assert!(part.enclosure().width() <= f64::EPSILON && one.magnitude().enclosure().least() > 0.0);
        }
        assert!(ratio(-1.0, 3.0).enclosure().contains(-1.0 / 3.0) && Ratio::of(0.3).unwrap().enclosure() == 0.3.into());
    }

    /// The unit of length has no effect, up to the smallest double.
    #[test]
    fn every_double_is_a_ratio() {
        for value in [5e-324, f64::MIN_POSITIVE, 1e-30, 0.1, 3.0, 1e30, f64::MAX] {
            assert_eq!(ratio(value, value), Ratio::ONE, "{value}");
            assert_eq!(ratio(-value, value), Ratio::ONE.negative(), "{value}");
        }
        assert_eq!(ratio(3.0 * 2_f64.powi(-900), 2_f64.powi(-901)), Ratio::of(6.0).unwrap());
        assert_eq!(Ratio::of(f64::NAN), None);
    }

    #[test]
    fn integers() {
        assert!(ratio(6.0, 3.0).is_integer() && ratio(0.0, 3.0).is_integer() && !ratio(3.0, 6.0).is_integer());
        assert!(!ratio(1.0, 3.0).is_integer() && Ratio::of(2_f64.powi(90)).unwrap().is_integer());
    }

    /// A result that does not fit is unknown, not wrong.
    #[test]
    fn overflow_is_none() {
        let small = Ratio::of(2_f64.powi(-200)).unwrap();
        assert_eq!(Ratio::ONE.plus(small), None);
        let long = Ratio::of(0.1).unwrap();
        assert_eq!(long.times(long).and_then(|square| square.times(long)), None);
        assert_eq!(Ratio::ZERO.inverse(), None);
    }
}
