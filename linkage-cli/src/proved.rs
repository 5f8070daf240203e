//! Enclosures for readers: all digits are proved.

use linkage_interval::Interval;
use linkage_runtime::Number;

/// The digits of a number.
const DIGITS: i32 = 8;

/// The most digits after the point: a rounding error of zero is printed as 0.
const MOST_DECIMALS: i32 = 12;

/// The width of an interval that is one number for readers, as a part of it.
const ONE_NUMBER: f64 = 1e-7;

/// A place that an interval contains, an angle in degrees: the digits that both of its ends have, or the ends, rounded apart.
pub fn proved(of: Interval, is_angle: bool) -> String {
    let (of, unit) = in_unit(of, is_angle);
    let size = of.magnitude();
    if !size.is_finite() {
        return "not bounded".to_owned();
    }
    let digits = |count: i32| (count - 1 - size.max(1e-12).log10().floor() as i32).clamp(0, MOST_DECIMALS) as usize;
    // The fewer digits, the wider an interval is one number.
    let same = (DIGITS - 1..=DIGITS).rev().find_map(|count| {
        let [one, other] = [of.least(), of.most()].map(|end| rounded(end, digits(count)));
        (one == other).then_some(one)
    });
    same.map_or_else(|| both(of, unit), |same| format!("{same}{unit}"))
}

/// The least value of a quantity, an angle in degrees, of which an interval is proved to contain it: rounded downward. Where the
/// interval is wider than a few digits, as with tolerances, both of its ends.
pub fn least(of: Interval, is_angle: bool) -> String {
    let (of, unit) = in_unit(of, is_angle);
    bound(of, of.least(), of.rounded_least(), unit)
}

/// The largest value likewise, rounded upward.
pub fn largest(of: Interval, is_angle: bool) -> String {
    let (of, unit) = in_unit(of, is_angle);
    bound(of, of.most(), of.rounded_most(), unit)
}

/// The outer end of an interval, or both.
fn bound(of: Interval, end: f64, rounded: String, unit: &str) -> String {
    match (end.is_finite(), of.magnitude().is_finite()) {
        (false, _) => "not bounded".to_owned(),
        (_, true) if of.width() > ONE_NUMBER * of.magnitude() => both(of, unit),
        _ => format!("{rounded}{unit}"),
    }
}

/// The ends of an interval, angles in degrees, rounded apart.
pub fn ends(of: Interval, is_angle: bool) -> [String; 2] {
    let (of, unit) = in_unit(of, is_angle);
    [of.rounded_least(), of.rounded_most()].map(|end| end + unit)
}

/// Both ends, rounded apart.
fn both(of: Interval, unit: &str) -> String {
    format!("{} to {}{unit}", of.rounded_least(), of.rounded_most())
}

fn in_unit(of: Interval, is_angle: bool) -> (Interval, &'static str) {
    if is_angle { (of * Interval::exactly(180.0) / Interval::pi(), "°") } else { (of, "") }
}

/// A number with so many decimals.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(least: f64, most: f64) -> Interval {
        Interval::new(least, most).expect("an interval")
    }

    #[test]
    fn digits_that_are_proved() {
        let of = |least: f64, most: f64| proved(interval(least, most), false);
        assert_eq!(of(35.0, 35.0), "35");
        assert_eq!(of(1.234_567_891, 1.234_567_892), "1.2345679");
        assert_eq!(of(1.0, 2.5), "1 to 2.5");
        assert_eq!(of(-1e-14, 1e-14), "0");
        // Rounded apart.
        assert_eq!(of(1.111_111_19, 2.222_222_21), "1.1111111 to 2.2222223");
        assert_eq!(of(-2.222_222_21, -1.111_111_19), "-2.2222223 to -1.1111111");
        assert_eq!(of(0.0, f64::INFINITY), "not bounded");
        let right = Interval::pi() / Interval::exactly(2.0);
        assert_eq!(proved(right, true), "90°");
    }

    #[test]
    fn bounds_are_rounded_outward() {
        let both = |from: f64, to: f64| [least, largest].map(|of| of(interval(from, to), false));
        assert_eq!(both(35.0, 35.0), ["35", "35"]);
        assert_eq!(both(1.644_600_01, 1.644_600_02), ["1.6446", "1.6446001"]);
        assert_eq!(both(-1e-15, 0.0), ["-1e-15 to 0", "-1e-15 to 0"]);
        assert_eq!(both(1.111_111_19, 2.222_222_21), ["1.1111111 to 2.2222223", "1.1111111 to 2.2222223"]);
        assert_eq!(both(1.0, f64::INFINITY), ["1", "not bounded"]);
        let right = Interval::pi() / Interval::exactly(2.0);
        assert_eq!([least, largest].map(|of| of(right, true)), ["89.999999°", "90.000001°"]);
    }
}
