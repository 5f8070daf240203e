//! Constants: exact ratios of integers, and `f64` where a ratio would overflow.

use core::fmt;
use core::hash::{Hash, Hasher};

use crate::Ratio;

/// A constant: an exact ratio in lowest terms with a positive denominator, or a float.
///
/// Arithmetic on ratios is exact; a result whose numerator or denominator leaves `i64`
/// becomes a float, never a wrapped integer.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Number {
    /// `numerator / denominator`.
    Ratio(i64, i64),
    /// A rounded value.
    Float(f64),
}

/// Integers up to this magnitude are exact in `f64`, so that the quotient of two is correctly rounded.
const EXACT_IN_F64: i128 = 1 << 53;

impl Number {
    pub const ZERO: Self = Self::Ratio(0, 1);
    pub const ONE: Self = Self::Ratio(1, 1);
    pub const MINUS_ONE: Self = Self::Ratio(-1, 1);

    #[must_use]
    pub fn integer(value: i64) -> Self {
        // i64::MIN has no absolute value in i64, so it becomes a float.
        if value == i64::MIN { Self::Float(value as f64) } else { Self::Ratio(value, 1) }
    }

    /// `numerator / denominator` in lowest terms; a zero denominator gives a non-finite float.
    #[must_use]
    pub fn ratio(numerator: i128, denominator: i128) -> Self {
        let exact = Ratio::quotient(numerator, denominator).and_then(Self::exactly);
        exact.unwrap_or(Self::Float(numerator as f64 / denominator as f64))
    }

    /// A ratio, or a float if it would overflow; `None` beyond 127 bits.
    fn exactly(ratio: Ratio) -> Option<Self> {
        let [numerator, denominator] = ratio.integers()?;
        Some(match (i64::try_from(numerator), i64::try_from(denominator)) {
            // i64::MIN has no absolute value in i64, so it becomes a float.
            (Ok(n), Ok(d)) if n != i64::MIN => Self::Ratio(n, d),
            _ => Self::Float(numerator as f64 / denominator as f64),
        })
    }

    /// `None` of a float.
    fn as_ratio(self) -> Option<Ratio> {
        match self {
            Self::Ratio(n, d) => Ratio::coprime(n.into(), d.into(), 0),
            Self::Float(_) => None,
        }
    }

    /// A computed float; NaN if it underflows, since a coefficient of zero would remove its term.
    fn float(value: f64, is_zero: bool) -> Self {
        let underflows = !is_zero && value.abs() < f64::MIN_POSITIVE;
        Self::Float(if underflows { f64::NAN } else { value })
    }

    /// Parses a decimal literal such as `1.25e-3`; exact if the quotient of its numerator and denominator is the `f64`
    /// that the literal denotes.
    #[must_use]
    pub fn parse(digits: &str) -> Option<Self> {
        let float: f64 = digits.parse().ok()?;
        let mantissa = digits.split(['e', 'E']).next().unwrap_or(digits);
        let is_zero = !mantissa.contains(|digit: char| matches!(digit, '1'..='9'));
        Some(Self::decimal(digits).unwrap_or(Self::float(float, is_zero)))
    }

    fn decimal(digits: &str) -> Option<Self> {
        let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (digits, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
        let scale = 10_i128.checked_pow(digits.unsigned_abs())?;
        let (sign, whole) = match whole.strip_prefix('-') {
            Some(whole) => (-1, whole),
            None => (1, whole.strip_prefix('+').unwrap_or(whole)),
        };
        let integer = whole.chars().chain(fraction.chars()).try_fold(0_i128, |integer, digit| {
            integer.checked_mul(10)?.checked_add(sign * i128::from(digit.to_digit(10)?))
        })?;
        let (n, d) = if digits < 0 { (integer, scale) } else { (integer.checked_mul(scale)?, 1) };
        match Self::ratio(n, d) {
            Self::Ratio(n, d) if exact_in_f64(n) && exact_in_f64(d) => Some(Self::Ratio(n, d)),
            _ => None,
        }
    }

    #[must_use]
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Ratio(n, d) => n as f64 / d as f64,
            Self::Float(value) => value,
        }
    }

    #[must_use]
    pub fn is_zero(self) -> bool {
        match self {
            Self::Ratio(n, _) => n == 0,
            Self::Float(value) => value == 0.0,
        }
    }

    #[must_use]
    pub fn is_one(self) -> bool {
        matches!(self, Self::Ratio(1, 1))
    }

    #[must_use]
    pub fn is_negative(self) -> bool {
        match self {
            Self::Ratio(n, _) => n < 0,
            Self::Float(value) => value < 0.0,
        }
    }

    #[must_use]
    pub fn is_finite(self) -> bool {
        self.to_f64().is_finite()
    }

    /// The value as an integer, if it is one.
    #[must_use]
    pub fn as_integer(self) -> Option<i64> {
        match self {
            Self::Ratio(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Numerator and denominator, if both are doubles.
    #[must_use]
    pub fn as_quotient(self) -> Option<[f64; 2]> {
        match self {
            Self::Ratio(n, d) => (exact_in_f64(n) && exact_in_f64(d)).then_some([n as f64, d as f64]),
            Self::Float(_) => None,
        }
    }

    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        match (self, other) {
            // Fast path: most sums have a zero.
            (sum @ Self::Ratio(..), Self::Ratio(0, _)) | (Self::Ratio(0, _), sum @ Self::Ratio(..)) => sum,
            _ => {
                let exact = self.as_ratio().zip(other.as_ratio()).and_then(|(one, other)| one.plus(other));
                let sum = || Self::Float(self.to_f64() + other.to_f64());
                exact.and_then(Self::exactly).unwrap_or_else(sum)
            }
        }
    }

    #[must_use]
    pub fn multiply(self, other: Self) -> Self {
        match (self, other) {
            // Fast path: most factors are 1 or -1.
            (Self::Ratio(1, 1), factor) | (factor, Self::Ratio(1, 1)) => factor,
            (Self::Ratio(-1, 1), factor) | (factor, Self::Ratio(-1, 1)) => factor.negate(),
            _ => {
                let exact = self.as_ratio().zip(other.as_ratio()).and_then(|(one, other)| one.times(other));
                let product = || Self::float(self.to_f64() * other.to_f64(), self.is_zero() || other.is_zero());
                exact.and_then(Self::exactly).unwrap_or_else(product)
            }
        }
    }

    #[must_use]
    pub fn negate(self) -> Self {
        match self {
            Self::Ratio(n, d) => Self::Ratio(-n, d),
            Self::Float(value) => Self::Float(-value),
        }
    }

    #[must_use]
    pub fn absolute(self) -> Self {
        if self.is_negative() { self.negate() } else { self }
    }

    /// `self^exponent`; zero to a negative power is not finite.
    #[must_use]
    pub fn power(self, exponent: i32) -> Self {
        if exponent == 1 || self.is_one() {
            return self;
        }
        let exact = self.as_ratio().and_then(|ratio| ratio.power(exponent));
        let power = || Self::float(float_power(self.to_f64(), exponent), self.is_zero());
        exact.and_then(Self::exactly).unwrap_or_else(power)
    }
}

fn exact_in_f64(value: i64) -> bool {
    i128::from(value).abs() >> value.trailing_zeros().min(63) <= EXACT_IN_F64
}

/// `f64::powi`, which `core` does not have, and whose bits Rust leaves open.
fn float_power(mut base: f64, exponent: i32) -> f64 {
    let (mut power, mut left) = (1.0, exponent.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power *= base;
        }
        base *= base;
        left >>= 1;
    }
    if exponent < 0 { 1.0 / power } else { power }
}

// Floats are compared by bits, so that numbers can be keys of hash maps.
impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

impl Number {
    fn key(self) -> (bool, i64, i64) {
        match self {
            Self::Ratio(n, d) => (true, n, d),
            Self::Float(value) => (false, value.to_bits().cast_signed(), 0),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ratio(n, 1) => write!(f, "{n}"),
            Self::Ratio(n, d) => write!(f, "{n}/{d}"),
            Self::Float(value) => write!(f, "{value:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn overflow_falls_to_float() {
        let large = Number::integer(i64::MAX);
        assert_eq!(large.plus(Number::ONE), Number::Float(i64::MAX as f64 + 1.0));
        assert_eq!(large.multiply(large), Number::Float((i64::MAX as f64).powi(2)));
        let tiny = Number::ratio(1, i128::from(i64::MAX));
        assert_eq!(tiny.plus(Number::ratio(1, i128::from(i64::MAX - 1))).to_f64(), 2.0 / i64::MAX as f64);
        assert_eq!(Number::integer(3).power(60), Number::Float(3_f64.powi(60)));
        assert!(!Number::ZERO.power(-1).is_finite());
        assert_eq!(Number::integer(-2).power(-127), Number::Float(-1.0 / (1_u128 << 127) as f64));
    }

    #[test]
    fn underflow_is_no_zero() {
        let small = Number::parse("1e-200").unwrap();
        assert!(!small.multiply(small).is_finite() && !small.power(2).is_finite());
        assert!(!Number::parse("1e-400").unwrap().is_finite() && !Number::parse("5e-324").unwrap().is_finite());
        assert!(Number::parse("0e-400").unwrap().is_zero() && Number::Float(0.0).multiply(small).is_zero());
        assert_eq!(Number::parse("2.3e-308").map(Number::to_f64), Some(2.3e-308));
    }

    #[test]
    fn literals_keep_the_value_rust_gives_them() {
        for text in ["0.1", "80.0", "1e300", "1e-300", "0.3490658503988659", "3.5e2", "123456789012345678901"] {
            let parsed = Number::parse(text).map(Number::to_f64);
            assert_eq!(parsed, text.parse().ok(), "{text}");
        }
        assert_eq!(Number::parse("1.25"), Some(Number::Ratio(5, 4)));
    }
}
