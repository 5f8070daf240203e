//! Round numbers for axes.

/// The multiples of a round step (1, 2 or 5 times a power of ten) between `low` and `high`, about five to ten.
pub(super) fn ticks(low: f64, high: f64) -> Vec<f64> {
    let step = round_step((high - low) / 6.0);
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first).max(0.0);
    // A step is about a sixth of the range, which bounds their number.
    (0..=20_u32).map(f64::from).take_while(|index| *index <= count).map(|index| (first + index) * step).collect()
}

/// The next round number above `rough`.
fn round_step(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let digit = [1.0, 2.0, 5.0, 10.0].into_iter().find(|digit| digit * power >= rough * (1.0 - 1e-9));
    digit.unwrap_or(10.0) * power
}

/// The label of a tick, with the digits that its step needs.
pub(super) fn label(value: f64, low: f64, high: f64) -> String {
    let step = round_step((high - low) / 6.0);
    let largest = low.abs().max(high.abs());
    if !(1e-3..1e5).contains(&largest) {
        return format!("{value:.1e}");
    }
    let mut decimals = 0;
    let mut unit = step;
    while decimals < 12 && (unit - unit.round()).abs() > 1e-6 * unit {
        unit *= 10.0;
        decimals += 1;
    }
    format!("{:.decimals$}", if value == 0.0 { 0.0 } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(-3.0, 83.0), [0.0, 20.0, 40.0, 60.0, 80.0]);
        assert_eq!(ticks(0.0, 1.0), [0.0, 0.2, 0.4, 0.600_000_000_000_000_1, 0.8, 1.0]);
        assert_eq!(label(0.600_000_000_000_000_1, 0.0, 1.0), "0.6");
        assert_eq!(label(20.0, -3.0, 83.0), "20");
        assert_eq!(label(2e6, 0.0, 1e7), "2.0e6");
    }
}
