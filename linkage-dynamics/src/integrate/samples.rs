//! Samples of guards at equal distances in a step, and the test that they are close enough together.
//!
//! The step length is no measure: it follows from the error of the state, and while everything sticks the state does
//! not change, however fast the margins of the frictions do. The sampling is refined until every four consecutive
//! values are close to a parabola.
//!
//! The margin of a contact without load is a rounding error, relative to loads that may pass zero: then it has a corner
//! at zero, |t - t0|, which is far from a parabola however close the samples are. Deviations that are small relative to
//! the largest value since the last restart do not count.

use linkage_runtime::{Build, Column, Dim};

/// The largest deviation of four values from a parabola, relative to the largest of them.
const ON_A_PARABOLA: f64 = 0.05;

/// Four values below this part of the largest value since the last restart are compared with that part instead of the
/// largest of them: 16^-5, as far as steps are shortened in a row.
const NEGLIGIBLE: f64 = 1e-6;

/// The last four values of each guard, newest first; None for a guard with a known rate: like the gap of an open stop,
/// it changes no faster than the state.
pub(super) struct Samples<C: Dim> {
    values: [Column<Option<f64>, C>; 4],
    count: usize,
    /// The largest value of each guard since the last restart.
    largest: Column<f64, C>,
}

impl<C: Dim> Samples<C> {
    pub(super) fn new(largest: Column<f64, C>) -> Self {
        Self { values: [largest.dim().repeat(None); 4], count: 0, largest }
    }

    pub(super) fn push(&mut self, values: Column<Option<f64>, C>) {
        let [a, b, c, _] = self.values;
        self.values = [values, a, b, c];
        self.count += 1;
    }

    /// Returns true if there are enough values for the test.
    pub(super) fn are_enough(&self) -> bool {
        self.count > 3
    }

    /// Returns true if some guard is too far from a parabola.
    pub(super) fn are_too_coarse(&self) -> bool {
        let [a, b, c, d] = &self.values;
        self.are_enough()
            && (0..self.largest.dim().count()).any(|i| {
                let (Some(a), Some(b), Some(c), Some(d)) = (a[i], b[i], c[i], d[i]) else { return false };
                let size = a.abs().max(b.abs()).max(c.abs()).max(d.abs()).max(NEGLIGIBLE * self.largest[i]);
                (a - d - 3.0 * (b - c)).abs() > ON_A_PARABOLA * size
            })
    }
}
