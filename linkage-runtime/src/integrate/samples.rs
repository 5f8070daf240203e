//! Guards at equal distances in a step: whether they are seen well enough, and where one turns.
//!
//! The error of a step tells nothing of how fast a guard changes: while all sticks, nothing moves. So it is looked at
//! more often until four values in a row are near a parabola, and where three of them have their vertex near zero.

/// Part of the greatest of four values up to which they are on a parabola.
const ON_A_PARABOLA: f64 = 0.05;

/// A vertex is looked at below this part of the values beside it.
const NEAR_ZERO: f64 = 0.5;

/// The last four values of each guard, the newest first.
pub(super) struct Samples<const C: usize> {
    values: [[f64; C]; 4],
    count: usize,
}

impl<const C: usize> Samples<C> {
    pub(super) fn new() -> Self {
        Self { values: [[0.0; C]; 4], count: 0 }
    }

    pub(super) fn push(&mut self, values: [f64; C]) {
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
            && (0..C).any(|i| {
                let size = a[i].abs().max(b[i].abs()).max(c[i].abs()).max(d[i].abs());
                (a[i] - d[i] - 3.0 * (b[i] - c[i])).abs() > ON_A_PARABOLA * size
            })
    }

    /// Where guards come near zero and turn, in distances from the last value but one.
    pub(super) fn turns(&self) -> impl Iterator<Item = f64> {
        let [new, middle, old, _] = self.values;
        let is_full = self.count > 2;
        (0..C).filter_map(move |i| {
            let (slope, bend) = (0.5 * (new[i] - old[i]), new[i] + old[i] - 2.0 * middle[i]);
            let least = new[i].min(middle[i]).min(old[i]);
            let turns = is_full && least > 0.0 && bend > 0.0 && slope.abs() < bend;
            let vertex = middle[i] - 0.5 * slope * slope / bend;
            (turns && vertex < NEAR_ZERO * least).then(|| -slope / bend)
        })
    }
}
