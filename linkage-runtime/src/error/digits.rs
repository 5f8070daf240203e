//! A number in a message, with three digits.

use core::fmt;

/// A number with three digits: `0.0512`, `50.0`, `1250`, and `1.25e9` or `5.12e-5` where zeros would be counted.
pub(super) struct Digits(pub f64);

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        // The number as it is written, so that 9.996 is 10.0.
        let bounds = [(9.995e-4, 5), (9.995e-3, 4), (9.995e-2, 3), (0.9995, 2), (9.995, 1), (99.95, 0)];
        let size = value.abs();
        if size == 0.0 {
            return f.write_str("0");
        }
        if !(9.995e-4..999_999.5).contains(&size) {
            return write!(f, "{value:.2e}");
        }
        let decimals = bounds.iter().rev().find(|(from, _)| size >= *from).map_or(0, |(_, decimals)| *decimals);
        write!(f, "{value:.decimals$}")
    }
}

#[cfg(test)]
mod tests {
    use super::Digits;

    #[test]
    fn three_digits_of_each_number() {
        let numbers = [
            (0.0, "0"),
            (50.0, "50.0"),
            (49.999_999_7, "50.0"),
            (-0.173, "-0.173"),
            (9.996, "10.0"),
            (0.999_6, "1.00"),
            (99.96, "100"),
            (1250.4, "1250"),
            (123_456.0, "123456"),
            (2.5e9, "2.50e9"),
            (5.123e-5, "5.12e-5"),
            (0.001, "0.00100"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ];
        for (number, expected) in numbers {
            assert_eq!(Digits(number).to_string(), expected);
        }
    }
}
