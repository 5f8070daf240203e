//! Ratios of integers, exactly.

/// n / d 2^e, where n and d are odd, d is positive and they have no common factor; zero is 0 / 1 2^0.
///
/// Every double is one, and another unit of length changes the exponent alone. A result whose n or d has more than 127
/// bits is `None`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ratio {
    numerator: i128,
    denominator: i128,
    exponent: i32,
}

impl Ratio {
    pub const ZERO: Self = Self { numerator: 0, denominator: 1, exponent: 0 };
    pub const ONE: Self = Self { numerator: 1, denominator: 1, exponent: 0 };

    /// The value of a double; `None` for NaN and infinity.
    #[must_use]
    pub fn of(value: f64) -> Option<Self> {
        /// A double is its fraction of 52 bits, with a leading 1 unless it is subnormal, times 2^(exponent - 1075).
        const FRACTION: u64 = (1 << 52) - 1;
        if !value.is_finite() {
            return None;
        }
        let (bits, biased) = (value.to_bits() & FRACTION, (value.to_bits() >> 52 & 0x7ff) as i32);
        let (fraction, exponent) = if biased == 0 { (bits, -1074) } else { (bits | (FRACTION + 1), biased - 1075) };
        let magnitude = i128::from(fraction);
        Self::coprime(if value < 0.0 { -magnitude } else { magnitude }, 1, exponent)
    }

    /// `numerator / denominator`; `None` if the denominator is zero.
    #[must_use]
    pub fn quotient(numerator: i128, denominator: i128) -> Option<Self> {
        Self::reduced(numerator, denominator, 0)
    }

    /// n, d and e.
    #[must_use]
    pub fn parts(self) -> (i128, i128, i32) {
        (self.numerator, self.denominator, self.exponent)
    }

    /// Numerator and denominator with the powers of two in them; `None` if one has more than 127 bits.
    #[must_use]
    pub fn integers(self) -> Option<[i128; 2]> {
        let [up, down] = [self.exponent, self.exponent.checked_neg()?].map(|exponent| exponent.max(0));
        Some([shifted(self.numerator, up)?, shifted(self.denominator, down)?])
    }

    #[must_use]
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    #[must_use]
    pub fn is_integer(self) -> bool {
        self.denominator == 1 && self.exponent >= 0
    }

    fn reduced(numerator: i128, denominator: i128, exponent: i32) -> Option<Self> {
        let Self { numerator, denominator, exponent } = Self::coprime(numerator, denominator, exponent)?;
        let divisor = common_divisor(numerator, denominator);
        Some(Self { numerator: numerator / divisor, denominator: denominator / divisor, exponent })
    }

    /// numerator / denominator 2^exponent, where the integers have no common factor but powers of two.
    pub(crate) fn coprime(numerator: i128, denominator: i128, exponent: i32) -> Option<Self> {
        if numerator == 0 || denominator == 0 {
            return (denominator != 0).then_some(Self::ZERO);
        }
        let [up, down] = [numerator, denominator].map(i128::trailing_zeros);
        let exponent = exponent.checked_add_unsigned(up)?.checked_sub_unsigned(down)?;
        // An odd integer has at most 127 bits, with either sign.
        let (numerator, denominator) = (numerator >> up, denominator >> down);
        let numerator = if denominator < 0 { -numerator } else { numerator };
        Some(Self { numerator, denominator: denominator.abs(), exponent })
    }

    #[must_use]
    pub fn plus(self, other: Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(if self.is_zero() { other } else { self });
        }
        let exponent = self.exponent.min(other.exponent);
        let above = |one: Self, other: Self| {
            shifted(one.numerator, one.exponent.checked_sub(exponent)?)?.checked_mul(other.denominator)
        };
        let numerator = above(self, other)?.checked_add(above(other, self)?)?;
        Self::reduced(numerator, self.denominator.checked_mul(other.denominator)?, exponent)
    }

    #[must_use]
    pub fn times(self, other: Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(Self::ZERO);
        }
        // Crosswise they may have common factors.
        let [one, two] =
            [common_divisor(self.numerator, other.denominator), common_divisor(other.numerator, self.denominator)];
        Some(Self {
            numerator: (self.numerator / one).checked_mul(other.numerator / two)?,
            denominator: (self.denominator / two).checked_mul(other.denominator / one)?,
            exponent: self.exponent.checked_add(other.exponent)?,
        })
    }

    /// 1 / self; `None` of zero.
    #[must_use]
    pub fn inverse(self) -> Option<Self> {
        Self::coprime(self.denominator, self.numerator, self.exponent.checked_neg()?)
    }

    /// self^exponent; `None` of zero to a negative power.
    #[must_use]
    pub fn power(self, exponent: i32) -> Option<Self> {
        let base = if exponent < 0 { self.inverse()? } else { self };
        Some(Self {
            numerator: base.numerator.checked_pow(exponent.unsigned_abs())?,
            denominator: base.denominator.checked_pow(exponent.unsigned_abs())?,
            exponent: self.exponent.checked_mul(exponent)?,
        })
    }

    /// The largest ratio of which both are whole multiples, where neither is zero.
    #[must_use]
    pub fn common_part(self, other: Self) -> Option<Self> {
        let numerator = common_divisor(self.numerator, other.numerator);
        let shared = common_divisor(self.denominator, other.denominator);
        let denominator = (self.denominator / shared).checked_mul(other.denominator)?;
        Self::reduced(numerator, denominator, self.exponent.min(other.exponent))
    }

    #[must_use]
    pub fn magnitude(self) -> Self {
        if self.numerator < 0 { self.negative() } else { self }
    }

    #[must_use]
    pub fn negative(self) -> Self {
        // The magnitude of a numerator is at most 2^127 - 1: it is odd.
        Self { numerator: self.numerator.wrapping_neg(), ..self }
    }
}

/// integer 2^by, where `by` is not negative; `None` if it has more than 127 bits.
fn shifted(integer: i128, by: i32) -> Option<i128> {
    let by = u32::try_from(by).ok()?;
    (by < integer.unsigned_abs().leading_zeros()).then(|| integer << by)
}

/// The greatest common divisor, which is positive, of odd integers.
fn common_divisor(one: i128, other: i128) -> i128 {
    let (mut divisor, mut rest) = (one.unsigned_abs(), other.unsigned_abs());
    while rest > 1 {
        (divisor, rest) = (rest, divisor % rest);
    }
    if rest == 1 { 1 } else { divisor.cast_signed() }
}

#[cfg(test)]
mod tests {
    extern crate std;

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
        }
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

    #[test]
    fn powers_and_quotients() {
        let power = |above, below, exponent| Ratio::quotient(above, below).and_then(|ratio| ratio.power(exponent));
        assert_eq!(power(-2, 3, -3), Some(ratio(-27.0, 8.0)));
        assert_eq!(power(-2, 1, -127).map(Ratio::parts), Some((-1, 1, -127)));
        assert_eq!((power(0, 1, 0), power(0, 1, 3), power(0, 1, -1)), (Some(Ratio::ONE), Some(Ratio::ZERO), None));
        assert_eq!(ratio(-12.0, 10.0).integers(), Some([-6, 5]));
        assert_eq!(Ratio::quotient(i128::MIN, i128::MIN), Some(Ratio::ONE));
        assert_eq!((Ratio::quotient(1, 0), Ratio::quotient(1, i128::MIN).and_then(Ratio::integers)), (None, None));
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
