//! Comparisons with a stated tolerance.

/// Equal to `tolerance` of `scale`, the largest of the numbers that were added to make it.
#[track_caller]
pub fn close(what: &str, found: f64, expected: f64, scale: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(error <= tolerance * scale, "{what}: {found:e} is not {expected:e}, off by {error:e} of {scale:e}");
}

/// Equal to `tolerance` of the largest entry.
#[track_caller]
pub fn all_close(what: &str, found: &[f64], expected: &[f64], scale: f64, tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(scale, |scale, value| scale.max(value.abs()));
    for (index, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        close(&format!("{what}[{index}]"), found, expected, scale, tolerance);
    }
}
