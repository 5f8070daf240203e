//! The gait of a leg, from the path of its foot over a turn of the crank at constant speed.

use linkage_sweep::{Case, Column, found};

/// The positions of a turn.
pub const POSITIONS: usize = 96;

/// The path of a foot in numbers. The ground phase is the half of the positions in which the foot is lowest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gait {
    /// The range of the foot's height in the ground phase, divided by the stride.
    pub unevenness: f64,
    /// The height of the path above the ground phase, divided by the stride.
    pub step: f64,
    /// The horizontal range of the foot in the ground phase.
    pub stride: f64,
    /// The largest height of the foot.
    pub top: f64,
}

/// The columns of the foot.
pub fn columns() -> [Column; 2] {
    [found("foot_x"), found("foot_y")]
}

impl Gait {
    /// The gait of a path; none if the foot is on the ground more than once in a turn.
    pub fn of([x, y]: [&[f64]; 2]) -> Option<Self> {
        let mut heights: [f64; POSITIONS] = y.try_into().ok()?;
        let (_, ground, _) = heights.select_nth_unstable_by(POSITIONS / 2 - 1, f64::total_cmp);
        let ground = *ground;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut back, mut front) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut changes = 0;
        let mut was_down = y[POSITIONS - 1] <= ground;
        for (x, y) in x.iter().zip(y) {
            let is_down = *y <= ground;
            changes += u32::from(is_down != was_down);
            was_down = is_down;
            (low, high) = (low.min(*y), high.max(*y));
            if is_down {
                (back, front) = (back.min(*x), front.max(*x));
            }
        }
        let stride = front - back;
        let (unevenness, step) = ((ground - low) / stride, (high - ground) / stride);
        (changes == 2).then_some(Self { unevenness, step, stride, top: high })
    }

    /// True if another gait is at least as flat with a step at least as high.
    pub fn is_no_better_than(&self, other: &Self) -> bool {
        other.unevenness <= self.unevenness && other.step >= self.step
    }

    /// The gait of a design that assembles in all positions.
    pub fn of_case(case: &Case<'_, f64, 2>) -> Option<Self> {
        if case.accepted.contains(&false) { None } else { Self::of(case.columns) }
    }
}

/// The condition for a comparison of designs: their foot stays below the circle of the crank, and they walk with at
/// least this stride.
#[derive(Debug, Clone, Copy)]
pub struct Condition {
    pub top: f64,
    pub least_stride: f64,
}

impl Condition {
    /// The gait of a design that fulfils the condition.
    pub fn gait(self, case: &Case<'_, f64, 2>) -> Option<Gait> {
        Gait::of_case(case).filter(|gait| gait.top < self.top && gait.stride >= self.least_stride)
    }
}
