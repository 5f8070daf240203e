//! Enclosures for readers: all digits are proved.

use linkage_interval::Interval;
use linkage_runtime::Number;

/// The digits of a number.
const DIGITS: i32 = 8;

/// The most digits after the point: a rounding error of zero is printed as 0.
const MOST_DECIMALS: i32 = 12;

/// A number that an interval contains, an angle in degrees: the digits that both of its ends have, or the ends, rounded apart.
pub fn proved(of: Interval, is_angle: bool) -> String {
    let [text] = all_proved([of], is_angle);
    text
}

/// Numbers of one quantity likewise: the largest has eight digits, the others as many decimals.
pub fn all_proved<const N: usize>(all: [Interval; N], is_angle: bool) -> [String; N] {
    let half_turn = Interval::exactly(180.0);
    let in_unit = |of: Interval| if is_angle { of * half_turn / Interval::pi() } else { of };
    let all = all.map(in_unit);
    let sizes = all.iter().map(|of| of.magnitude()).filter(|size| size.is_finite());
    let size = sizes.fold(0.0, f64::max);
    all.map(|of| text(of, size, if is_angle { "°" } else { "" }))
}

fn text(of: Interval, size: f64, unit: &str) -> String {
    let [least, most] = [of.least(), of.most()];
    if !of.magnitude().is_finite() {
        return "not bounded".to_owned();
    }
    let digits = |count: i32| (count - 1 - size.max(1e-12).log10().floor() as i32).clamp(0, MOST_DECIMALS) as usize;
    // The fewer digits, the wider an interval is one number.
    let same = (DIGITS - 1..=DIGITS).rev().find_map(|count| {
        let [one, other] = [least, most].map(|end| rounded(end, digits(count), 0.0));
        (one == other).then_some(one)
    });
    match same {
        Some(same) => format!("{same}{unit}"),
        None => {
            let ends = [rounded(least, digits(DIGITS), -1.0), rounded(most, digits(DIGITS), 1.0)];
            format!("{} to {}{unit}", ends[0], ends[1])
        }
    }
}

/// A number with so many decimals, rounded towards a side, or to the nearest.
fn rounded(value: f64, decimals: usize, side: f64) -> String {
    let mut text = format!("{value:.decimals$}");
    let off = text.parse::<f64>().map_or(0.0, |shown| (value - shown) * side);
    if off > 0.0 {
        // One unit of the last digit farther.
        text = format!("{:.decimals$}", value + side * 0.5_f64 * 10_f64.powi(-(decimals as i32)));
    }
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_are_proved() {
        let of = |least: f64, most: f64| proved(Interval::new(least, most).expect("an interval"), false);
        assert_eq!(of(35.0, 35.0), "35");
        assert_eq!(of(1.234_567_891, 1.234_567_892), "1.2345679");
        assert_eq!(of(1.0, 2.5), "1 to 2.5");
        assert_eq!(of(-1e-14, 1e-14), "0");
        // Rounded apart.
        assert_eq!(of(1.111_111_19, 2.222_222_21), "1.1111111 to 2.2222223");
        assert_eq!(of(-2.222_222_21, -1.111_111_19), "-2.2222223 to -1.1111111");
        assert_eq!(of(0.0, f64::INFINITY), "not bounded");
        // Next to larger numbers of the same quantity.
        let small = Interval::new(1e-15, 2e-15).expect("an interval");
        assert_eq!(all_proved([small, Interval::exactly(2.5)], false), ["0", "2.5"]);
        let right = Interval::pi() / Interval::exactly(2.0);
        assert_eq!(proved(right, true), "90°");
    }
}
