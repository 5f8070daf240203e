//! The certificate of a motion.

use linkage_runtime::{Certifiable, Column, Dim, Number};

use super::motion::unknowns_of;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;

/// The end of a certified motion over full turns of its input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// The motion is at its start again, after these full turns of the unknowns: it is closed, without a jump, a gap or
    /// a dead point.
    Closed {
        /// The full turns of each unknown.
        turns: Vec<i64>,
    },
    /// The motion arrives at another of the positions given, after these full turns of the unknowns.
    Arrives {
        /// The number of the position among those given.
        position: usize,
        /// The full turns of each unknown.
        turns: Vec<i64>,
    },
    /// The motion covers the range and ends at no position given.
    Open,
}

/// A proof that one motion exists and is continuous and regular over a range of its input.
///
/// For each value of the input there is exactly one position in the tube that covers it, the determinant of J is not
/// zero there, and the positions are one motion, continuously differentiable. With tolerances this holds for each
/// mechanism whose parameters are within them.
pub struct Certificate<M: Certifiable> {
    pub(super) system: System<M>,
    pub(super) tubes: Vec<Tube>,
    pub(super) end: End,
    pub(super) tests: usize,
    pub(super) inputs: Interval,
    pub(super) start: Vec<Interval>,
}

impl<M: Certifiable> Certificate<M> {
    /// The range of the input.
    #[must_use]
    pub fn inputs(&self) -> Interval {
        self.inputs
    }

    /// The end of the motion.
    #[must_use]
    pub fn end(&self) -> &End {
        &self.end
    }

    /// True if the motion is at its start again.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self.end, End::Closed { .. })
    }

    /// The number of tubes.
    #[must_use]
    pub fn boxes(&self) -> usize {
        self.tubes.len()
    }

    /// The number of tests for them, those that failed included.
    #[must_use]
    pub fn tests(&self) -> usize {
        self.tests
    }

    /// The start: the enclosure of the unknowns at the first input.
    #[must_use]
    pub fn start(&self) -> Column<Interval, M::U> {
        unknowns_of::<M>(&self.start)
    }

    /// The tubes in the order of the motion: the inputs of each, and a box that contains the unknowns at all of them.
    pub fn tubes(&self) -> impl Iterator<Item = (Interval, Column<Interval, M::U>)> + '_ {
        self.tubes.iter().map(|tube| (tube.range, unknowns_of::<M>(&tube.over(tube.range))))
    }

    /// Encloses the unknowns at an input, or at all inputs of an interval; `None` outside the range.
    #[must_use]
    pub fn unknowns_at(&self, input: Interval) -> Option<Column<Interval, M::U>> {
        if !input.is_within(self.inputs) {
            return None;
        }
        let parts = self.tubes.iter().filter_map(|tube| {
            let c = input.intersection(tube.range)?;
            let part = tube.part(&self.system, Dimensions::All, c);
            Some(unknowns_of::<M>(&part.map_or_else(|| tube.over(c), |part| part.q)))
        });
        parts.reduce(|one, other| Column::from_fn(|place| one[place].hull(other[place])))
    }

    /// The number of unknowns.
    #[must_use]
    pub fn count(&self) -> usize {
        M::U::COUNT
    }
}

/// The multiples of full turns nearest to the differences of two boxes in the unknowns whose formulas repeat, and the
/// second box moved by them.
pub(super) fn moved_by_turns<M: Certifiable>(
    end: &[Interval],
    start: &[Interval],
    input_turns: i64,
) -> (Vec<i64>, Vec<Interval>) {
    let two_pi = Interval::pi() + Interval::pi();
    let moved = |x: Interval, turns: i64| {
        if turns == 0 { x } else { x + two_pi * Interval::from(turns as f64) }
    };
    let turns_of = |((end, start), &period): ((&Interval, &Interval), &u32)| {
        if period == 0 {
            return 0;
        }
        let period = f64::from(period);
        let turns = ((end.middle() - start.middle()) / (two_pi.middle() * period)).round() * period;
        // 2^53 turns: all whole numbers are doubles up to there.
        if turns.abs() < 9e15 { turns as i64 } else { 0 }
    };
    let turns: Vec<i64> = end.iter().zip(start).zip(M::UNKNOWN_PERIODS).map(turns_of).collect();
    let all = turns.iter().copied().chain([input_turns]);
    let q = start.iter().zip(all).map(|(&x, turns)| moved(x, turns)).collect();
    (turns, q)
}
