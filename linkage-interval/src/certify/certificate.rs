//! The certificate of a motion.

use std::f64::consts::TAU;
use std::fmt;

use linkage_runtime::{Certifiable, Column, Number};

use super::motion::unknowns_of;
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;
use crate::enclose::{EncloseError, EncloseErrorOf, PoseBox, Sizes};

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

/// The statement that is proved, in one line, with angles in degrees: `FourBar: one motion without dead points, theta2 from 0° to
/// 360°, at its start again`.
impl<M: Certifiable> fmt::Display for Certificate<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { system, end, inputs, .. } = self;
        write!(f, "{}: one motion without dead points, {} from ", system.mechanism.name(), system.input_name())?;
        system.shown_input(inputs.least()).fmt(f)?;
        f.write_str(" to ")?;
        system.shown_input(inputs.most()).fmt(f)?;
        match end {
            End::Closed { .. } => f.write_str(", at its start again")?,
            End::Arrives { position, .. } => write!(f, ", to the position with the number {position} of those given")?,
            End::Open => {}
        }
        f.write_str(system.shown_tolerances())
    }
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
        unknowns_of(&self.system, &self.start)
    }

    /// The tubes in the order of the motion: the inputs of each, and a box that contains the unknowns at all of them.
    pub fn tubes(&self) -> impl Iterator<Item = (Interval, Column<Interval, M::U>)> + '_ {
        self.tubes.iter().map(|tube| (tube.range, unknowns_of(&self.system, &tube.over(tube.range))))
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
            Some(unknowns_of(&self.system, &part.map_or_else(|| tube.over(c), |part| part.q)))
        });
        parts.reduce(|one, other| one.zip_map(&other, Interval::hull))
    }

    /// The box of the unknowns at an input, or at all inputs of an interval, with the parameters of the certificate: its
    /// velocities, accelerations and sensitivities are those of the motion there.
    ///
    /// # Errors
    /// [`EncloseError::Outside`] if an input is outside the range, and those of [`PoseBox::with_parameters`]: where the
    /// motion turns much, a box of positions is wider than the motion in it, and narrower inputs are needed.
    pub fn pose_box(&self, input: Interval) -> Result<PoseBox<M>, EncloseErrorOf<M>> {
        let outside = EncloseError::Outside { mechanism: self.system.mechanism.name(), input, inputs: self.inputs };
        let unknowns = self.unknowns_at(input).ok_or(outside)?;
        let q: Vec<Interval> = unknowns.iter().copied().chain([input]).collect();
        let unknowns = self.system.scales.iter().copied().take(self.system.count()).collect();
        let sizes = Sizes { rows: self.system.rows.clone(), unknowns };
        PoseBox::of_numbers(&self.system.mechanism, self.system.numbers(&q), &sizes)
    }
}

/// A box in a tube after full turns of its angles, after which Psi is the same.
pub(super) struct Moved {
    /// The turns of the unknowns.
    pub(super) turns: Vec<i64>,
    pub(super) input_turns: i64,
    pub(super) q: Vec<Interval>,
}

impl Moved {
    /// Moves a box into a tube; `None` if no full turns do, or if Psi is not the same after them.
    pub(super) fn into_tube<M: Certifiable>(system: &System<M>, tube: &Tube, start: &[Interval]) -> Option<Self> {
        let parameter = tube.expansion.parameter;
        let from = start.get(parameter)?.middle();
        let [first, last] = if system.is_angle(parameter) {
            [turns(((tube.range.least() - from) / TAU).floor()), turns(((tube.range.most() - from) / TAU).ceil())]
        } else {
            [0; 2]
        };
        (first..=last).find_map(|turns| Self::by_parameter(system, tube, start, turns))
    }

    /// Moves a box by these turns of the parameter, and by the turns of the other angles that are nearest to the tube.
    fn by_parameter<M: Certifiable>(
        system: &System<M>,
        tube: &Tube,
        start: &[Interval],
        by_parameter: i64,
    ) -> Option<Self> {
        let two_pi = Interval::pi() + Interval::pi();
        let after = |x: Interval, turns: i64| if turns == 0 { x } else { x + two_pi * Interval::from(turns as f64) };
        let parameter = tube.expansion.parameter;
        let center = tube.expansion.over(after(*start.get(parameter)?, by_parameter));
        let turns_of = |place: usize| match center.get(place).zip(start.get(place)) {
            _ if place == parameter => by_parameter,
            Some((center, start)) if system.is_angle(place) => {
                turns(((center.middle() - start.middle()) / TAU).round())
            }
            _ => 0,
        };
        let mut turns: Vec<i64> = (0..start.len()).map(turns_of).collect();
        let q: Vec<Interval> = start.iter().zip(&turns).map(|(&x, &turns)| after(x, turns)).collect();
        let is_again = tube.contains(&q) && system.repeats(&turns);
        let input_turns = turns.pop()?;
        is_again.then_some(Self { turns, input_turns, q })
    }
}

/// A whole number of full turns; 0 beyond those that are doubles.
fn turns(turns: f64) -> i64 {
    /// Up to here all whole numbers are doubles.
    const MOST_TURNS: f64 = 9e15;
    if turns.abs() < MOST_TURNS { turns as i64 } else { 0 }
}
