//! Guards at equal distances in a step: whether they are seen well enough.
//!
//! The error of a step tells nothing of how fast a guard changes: while all sticks, nothing moves. So it is looked at
//! more often until four values in a row are near a parabola.

use linkage_runtime::{Column, Dim};

/// Part of the greatest of four values up to which they are on a parabola.
const ON_A_PARABOLA: f64 = 0.05;

/// The last four values of each guard, the newest first; none of one whose rate the system knows, which follows from
/// the state as exactly as that is followed.
pub(super) struct Samples<C: Dim> {
    values: [Column<Option<f64>, C>; 4],
    count: usize,
}

impl<C: Dim> Samples<C> {
    pub(super) fn new() -> Self {
        Self { values: [Column::repeat(None); 4], count: 0 }
    }

    pub(super) fn push(&mut self, values: Column<Option<f64>, C>) {
        let [a, b, c, _] = self.values;
        self.values = [values, a, b, c];
        self.count += 1;
    }

    /// Whether there are as many as it takes to tell whether a guard is seen well.
    pub(super) fn are_enough(&self) -> bool {
        self.count > 3
    }

    /// Whether some guard changes too much from one to the next to be followed.
    pub(super) fn are_unclear(&self) -> bool {
        let [a, b, c, d] = &self.values;
        self.are_enough()
            && (0..C::COUNT).any(|i| {
                let (Some(a), Some(b), Some(c), Some(d)) = (a[i], b[i], c[i], d[i]) else { return false };
                let size = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
                (a - d - 3.0 * (b - c)).abs() > ON_A_PARABOLA * size
            })
    }
}
