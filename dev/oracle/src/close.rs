//! Comparisons with a stated error.

use std::fmt::Display;

/// Asserts that a number is off by at most `error`.
///
/// # Panics
/// If it is not, or if one of the three is not a number.
#[track_caller]
pub fn close(what: impl Display, found: f64, expected: f64, error: f64) {
    let off = (found - expected).abs();
    assert!(off <= error, "{what}: {found:e} is not {expected:e}: off by {off:e}, {error:e} is allowed");
}

/// Asserts that each of a list of numbers is off by at most `tolerance` times the largest of them, or times a larger scale.
///
/// # Panics
/// If one is not, or if the lists differ in length.
#[track_caller]
pub fn all_close(what: &str, found: &[f64], expected: &[f64], scale: f64, tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(scale, |scale, value| scale.max(value.abs()));
    for (index, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        close(format_args!("{what}[{index}]"), found, expected, tolerance * scale);
    }
}
