//! Bounds as decimals for readers, rounded outward.

use super::Interval;

/// The significant digits of a bound.
const DIGITS: usize = 8;

/// The exponents of numbers that are written without one.
const PLAIN: std::ops::RangeInclusive<i32> = -5..=11;

impl Interval {
    /// The lower bound as a decimal of eight digits, rounded downward: `-0.37720953`, `2.6881171e43`.
    #[must_use]
    pub fn rounded_least(self) -> String {
        rounded(self.least(), -1)
    }

    /// The upper bound as a decimal of eight digits, rounded upward.
    #[must_use]
    pub fn rounded_most(self) -> String {
        rounded(self.most(), 1)
    }
}

/// A number as a decimal that is not on the other side of it. A decimal that reads as the number itself is that number.
fn rounded(value: f64, side: i64) -> String {
    let nearest = format!("{value:.*e}", DIGITS - 1);
    let read = || {
        let (digits, exponent) = nearest.split_once('e')?;
        let digits: i64 = digits.replace('.', "").parse().ok()?;
        Some((digits, exponent.parse::<i32>().ok()?, nearest.parse::<f64>().ok()?))
    };
    // Infinity has no digits.
    let Some((digits, exponent, shown)) = read() else { return nearest };
    let is_beyond = if side < 0 { shown > value } else { shown < value };
    let unit = exponent + 1 - DIGITS as i32;
    match is_beyond {
        false => decimal(digits, unit),
        // Next to a power of ten, on the side of zero, units are smaller.
        true if digits.unsigned_abs() == 10_u64.pow(DIGITS as u32 - 1) && digits.signum() != side => {
            decimal(10 * digits + side, unit - 1)
        }
        true => decimal(digits + side, unit),
    }
}

/// A whole number of units, each a power of ten, without zeros at the end.
fn decimal(units: i64, mut exponent: i32) -> String {
    let mut digits = units.unsigned_abs();
    if digits == 0 {
        return "0".to_owned();
    }
    while digits.is_multiple_of(10) {
        digits /= 10;
        exponent += 1;
    }
    let sign = if units < 0 { "-" } else { "" };
    let digits = digits.to_string();
    let leading = exponent + digits.len() as i32 - 1;
    let point = |before: usize| match digits.split_at(before) {
        (whole, "") => whole.to_owned(),
        (whole, part) => format!("{whole}.{part}"),
    };
    match usize::try_from(leading) {
        _ if !PLAIN.contains(&leading) => format!("{sign}{}e{leading}", point(1)),
        Ok(places) if places < digits.len() => format!("{sign}{}", point(places + 1)),
        Ok(places) => format!("{sign}{digits}{}", "0".repeat(places + 1 - digits.len())),
        Err(_) => format!("{sign}0.{}{digits}", "0".repeat((-leading - 1).unsigned_abs() as usize)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_outward() {
        for (value, below, above) in [
            (0.0, "0", "0"),
            (-0.0, "0", "0"),
            (35.0, "35", "35"),
            (1.1, "1.1", "1.1"),
            (-0.1, "-0.1", "-0.1"),
            (1.234_567_891, "1.2345678", "1.2345679"),
            (-1.234_567_891, "-1.2345679", "-1.2345678"),
            (0.999_999_999, "0.99999999", "1"),
            (-0.999_999_999, "-1", "-0.99999999"),
            (1.000_000_000_1, "1", "1.0000001"),
            (99_999_999.5, "99999999", "100000000"),
            (123_456_789.3, "123456780", "123456790"),
            (1.5e-5, "0.000015", "0.000015"),
            (-1.23e-14, "-1.23e-14", "-1.23e-14"),
            (2.688_117_141_816e43, "2.6881171e43", "2.6881172e43"),
            (f64::MAX, "1.7976931e308", "1.7976932e308"),
            (f64::INFINITY, "inf", "inf"),
        ] {
            assert_eq!([rounded(value, -1), rounded(value, 1)], [below, above], "{value:?}");
        }
    }

    /// For numbers of all sizes.
    #[test]
    fn a_decimal_is_on_its_side() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f64::from_bits(bits);
            if !value.is_finite() {
                continue;
            }
            let [below, above] = [-1, 1].map(|side| rounded(value, side).parse::<f64>().expect("a number"));
            assert!(below <= value && value <= above, "{value:?}: {below:?} {above:?}");
            assert!(
                value.abs() < 1e-300 || above - below <= 1.000_001e-7 * value.abs(),
                "{value:?}: {below:?} {above:?}"
            );
        }
    }
}
