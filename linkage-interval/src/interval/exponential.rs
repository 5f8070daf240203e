//! The exponential function and the logarithm, by their series in intervals: no other bound of a rounding error is
//! needed.

use std::f64::consts::LN_2;

use linkage_runtime::Number;

use super::Interval;

/// ln 2 = 0x0.b17217f7d1cf79abc9e3b398..., the first part of 32 bits, so that its product with an exponent is exact.
const LN_2_UPPER: f64 = f64::from_bits(0x3fe6_2e42_fee0_0000);
/// The remainder of ln 2, about 1.9e-10: the double nearest below and its neighbour.
const LN_2_LOWER: Interval = {
    let least = f64::from_bits(0x3dea_39ef_3579_3c76);
    Interval { least, most: least.next_up() }
};

/// Beyond these arguments the exponential function is above the largest double or below the least.
const RANGE: [f64; 2] = [-746.0, 710.0];

impl Interval {
    pub(super) fn exponential(self) -> Self {
        Self { least: exponential(self.least).least, most: exponential(self.most).most }
    }

    /// All real numbers if there are others in the interval than positive ones.
    pub(super) fn logarithm(self) -> Self {
        if self.least <= 0.0 {
            return Self::ENTIRE;
        }
        let most = if self.most.is_finite() { logarithm(self.most).most } else { f64::INFINITY };
        Self { least: logarithm(self.least).least, most }
    }

    /// k ln 2
    fn multiple_of_ln_2(k: f64) -> [Self; 2] {
        let k = Self::from(k);
        [k * Self::from(LN_2_UPPER), k * LN_2_LOWER]
    }
}

/// 2^exponent for exponents of normal numbers.
fn power_of_two(exponent: i32) -> Interval {
    let biased = 1023 + exponent.clamp(-1022, 1023);
    f64::from_bits(u64::from(biased.unsigned_abs()) << 52).into()
}

/// e^x = 2^k e^r, r = x - k ln 2.
fn exponential(x: f64) -> Interval {
    /// The largest |r| is 0.347; the first omitted term is r^16 / 16!, which is 2^-68.
    const TERMS: u8 = 15;
    if x < RANGE[0] {
        return Interval { least: 0.0, most: f64::from_bits(1) };
    }
    if x > RANGE[1] {
        return Interval { least: f64::MAX, most: f64::INFINITY };
    }
    let k = (x / LN_2).round();
    let [upper, lower] = Interval::multiple_of_ln_2(k);
    let r = (Interval::from(x) - upper) - lower;
    // Lagrange: the remainder is r^16 / 16! e^s, where s is between 0 and r and e^s below 2. From the last term inward it
    // is the first factor: 1 + r / 16 e^s.
    let last = r * Interval { least: 0.0, most: 2.0 } / Interval::from(f64::from(TERMS + 1));
    let sum = (1..=TERMS).rev().fold(last, |rest, n| r / f64::from(n).into() * (Interval::one() + rest));
    let k = k as i32;
    (Interval::one() + sum) * power_of_two(k / 2) * power_of_two(k - k / 2)
}

/// ln x = k ln 2 + ln m, x = 2^k m, ln m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1) / (m + 1).
fn logarithm(x: f64) -> Interval {
    /// s^2 is below 0.0295; the first omitted term of the sum in parentheses, divided by s, is 2^-66.
    const TERMS: u8 = 12;
    /// A subnormal number times 2^54 is normal.
    const SCALE: f64 = 18_014_398_509_481_984.0;
    let (x, shift) = if x < f64::MIN_POSITIVE { (x * SCALE, 54) } else { (x, 0) };
    let bits = x.to_bits();
    let m = f64::from_bits(bits & 0x000f_ffff_ffff_ffff | 0x3ff0_0000_0000_0000);
    let exponent = (bits >> 52) as i32 - 1023 - shift;
    let (m, k) = if m > std::f64::consts::SQRT_2 { (0.5 * m, exponent + 1) } else { (m, exponent) };
    let (m, one) = (Interval::from(m), Interval::one());
    let s = (m - one) / (m + one);
    let z = s.squared();
    // The remainder of the series is its first term times a number from 1 to 1 / (1 - s^2) < 2.
    let last = Interval { least: 0.0, most: 2.0 } / Interval::from(f64::from(2 * TERMS + 1));
    let rest = (1..TERMS).rev().fold(last, |rest, n| one / f64::from(2 * n + 1).into() + z * rest);
    let [upper, lower] = Interval::multiple_of_ln_2(k.into());
    let twice = s + s;
    upper + (twice + (lower + twice * z * rest))
}
