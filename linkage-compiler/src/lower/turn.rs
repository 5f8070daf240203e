//! Constants that are multiples of pi.

use std::f64::consts::PI;

use crate::graph::Number;

/// (count, parts) if the number is count * pi / parts with parts up to 180.
#[must_use]
pub fn parts_of_pi(number: Number) -> Option<(i32, u32)> {
    /// Fractions with larger counts are so close together that any number is near one.
    const MOST: f64 = 1e6;
    let Number::Float(value) = number else { return None };
    // 180 parts are whole degrees; finer fractions of pi are written as decimals.
    (1..=180_u32).find_map(|parts| {
        let of = f64::from(parts);
        let count = (value / PI * of).round();
        let same =
            count != 0.0 && count.abs() < MOST && (count * PI / of - value).abs() <= 4.0 * f64::EPSILON * value.abs();
        same.then_some((count as i32, parts))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_of_pi_have_small_counts() {
        for (count, parts) in [(1, 1), (2, 3), (7, 180), (999_999, 1)] {
            let number = Number::Float(f64::from(count) * PI / f64::from(parts));
            assert_eq!(parts_of_pi(number), Some((count, parts)));
        }
        for large in [1e17, 1e154, 1e300] {
            assert_eq!(parts_of_pi(Number::Float(large)), None);
        }
    }
}
