//! Factors of angles, such as a ratio of numbers of teeth, as intervals.

use linkage_ir::Ratio;
use linkage_runtime::Number;

use crate::Interval;

/// An interval that contains a ratio.
pub(crate) fn enclosure(ratio: Ratio) -> Interval {
    let is_double = |integer: i128| integer.unsigned_abs() < 1 << 53;
    let of = |integer: i128| {
        if is_double(integer) { Interval::exactly(integer as f64) } else { Interval::near(integer as f64) }
    };
    let (numerator, denominator, exponent) = ratio.parts();
    // A power that is no double leaves nothing known.
    let power = 2_f64.powi(exponent);
    let power = if power > 0.0 { Interval::exactly(power) } else { Interval::ENTIRE };
    of(numerator) / of(denominator) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn enclosures_contain_the_ratio() {
        for (above, below) in [(2, 1), (1, 6), (1, 10), (2, 3)] {
            let enclosure = enclosure(Ratio::quotient(above, below).unwrap());
            assert!(enclosure.width() <= f64::EPSILON && enclosure.least() > 0.0, "{above} / {below}");
        }
        assert!(enclosure(Ratio::quotient(-1, 3).unwrap()).contains(-1.0 / 3.0));
        assert_eq!(enclosure(Ratio::of(0.3).unwrap()), 0.3.into());
    }
}
