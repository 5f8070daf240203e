//! Rows at a kink, as that of `abs(x - 1)` at x = 1, which has no derivative there: what is the same on both sides stays.

use linkage_runtime::{Name, PositionError};

/// The units in the last place of its input by which a row is next to a kink: at the first the sign may still be zero.
pub const NEXT_TO_KINK: [f64; 3] = [4.0, 64.0, 1024.0];

/// Numbers on both sides of a kink that differ by more than this part of themselves are different.
const SAME: f64 = 1e-8;

/// Numbers up to this part of the largest one of the row are rounding errors.
const ROUNDED: f64 = 1e-14;

/// The numbers of a row at a kink, from those of the rows next to it on both sides: NaN for those that differ, and for the second
/// derivative of what has no first one, by the names of their columns.
#[must_use]
pub fn at_kink(names: &[&str], before: &[f64], after: &[f64]) -> Vec<f64> {
    let largest = before.iter().chain(after).fold(0.0_f64, |largest, number| largest.max(number.abs()));
    let of_both = |(before, after): (&f64, &f64)| {
        let size = before.abs().max(after.abs());
        let is_same = (before - after).abs() <= SAME * size + ROUNDED * largest;
        if is_same { f64::midpoint(*before, *after) } else { f64::NAN }
    };
    let mut numbers: Vec<f64> = before.iter().zip(after).map(of_both).collect();
    let ends = |name: &str| name.strip_suffix("_acceleration").map(|of| format!("{of}_rate"));
    for place in 1..numbers.len() {
        let is_of = ends(names[place]).is_some_and(|rate| rate == names[place - 1]);
        if is_of && numbers[place - 1].is_nan() {
            numbers[place] = f64::NAN;
        }
    }
    numbers
}

/// The row at a kink, if there are rows next to it at both sides; `row` is given the distance in units in the last place.
pub(super) fn next_to_kink(names: &[&str], row: impl Fn(f64) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
    NEXT_TO_KINK.into_iter().find_map(|distance| Some(at_kink(names, &row(-distance)?, &row(distance)?)))
}

/// True for what is not finite, as a derivative at a kink is not.
pub(super) fn may_be_kink<N: Name>(error: &PositionError<N>) -> bool {
    matches!(error, PositionError::NotFinite { .. })
}
