//! One motion: its points in the order of travel, with the modes, dead points and change points among them.

use std::vec::Vec;

use crate::{RangeEnd, Real};

/// An event of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CurveEvent<N = &'static str> {
    /// The input is a start input; the mode, or none if the position is not in the list: whole turns of an angle change
    /// it, as with gears.
    Mode(Option<usize>),
    /// The input reverses.
    DeadPoint {
        /// The unknowns of the group that is singular.
        group: N,
    },
    /// A coordinate or an output is at an end of the range that the mechanism declares; the motion ends there.
    JointRange {
        /// Its name.
        of: N,
        /// The end of its range.
        end: RangeEnd,
    },
    /// Motions cross.
    ChangePoint {
        /// The unknowns of the first group that is singular.
        group: N,
    },
}

/// A point of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CurvePoint<Q, T = f64, N = &'static str> {
    /// The input.
    pub input: T,
    /// The position.
    pub position: Q,
    /// The event there, if any.
    pub event: Option<CurveEvent<N>>,
}

/// The end of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CurveEnd {
    /// The motion is at its start again.
    Closed {
        /// The number of turns that the input has made; zero if it goes to and fro, or is a length.
        turns: i32,
    },
    /// The motion ends at limits of the range of the input, or where a coordinate or an output is at an end of its declared
    /// range: the first and the last point say so.
    Limits,
    /// A coordinate went farther than [`most_turns`](super::CircuitOptions::most_turns), and the motion did not close.
    Open,
}

/// A dead point or a change point of a motion, with its modes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CurveMeeting<Q, T = f64, N = &'static str> {
    /// The point.
    pub point: CurvePoint<Q, T, N>,
    /// The modes passed last before and first after it: at a dead point those that meet there. None if the motion passes
    /// no start input before the next dead point or its end, or if that mode is not in the list.
    pub modes: [Option<usize>; 2],
}

/// A motion, in the order of travel. It begins with the mode from which it was followed, the input increasing; with
/// limits, at one of them.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionCurve<Q, T = f64, N = &'static str> {
    /// Its points; the last one of a closed motion is the first again.
    pub points: Vec<CurvePoint<Q, T, N>>,
    /// Its end.
    pub end: CurveEnd,
}

impl<Q: Copy, T: Real, N: Copy> MotionCurve<Q, T, N> {
    /// The modes in the order of travel.
    pub fn modes(&self) -> impl Iterator<Item = usize> + '_ {
        self.points.iter().filter_map(|point| match point.event {
            Some(CurveEvent::Mode(mode)) => mode,
            _ => None,
        })
    }

    /// The dead points, where the input reverses.
    pub fn dead_points(&self) -> impl Iterator<Item = CurveMeeting<Q, T, N>> + '_ {
        self.meetings(|event| matches!(event, CurveEvent::DeadPoint { .. }))
    }

    /// The change points, where motions cross.
    pub fn change_points(&self) -> impl Iterator<Item = CurveMeeting<Q, T, N>> + '_ {
        self.meetings(|event| matches!(event, CurveEvent::ChangePoint { .. }))
    }

    /// The ends of declared ranges at which the motion ends.
    pub fn joint_ranges(&self) -> impl Iterator<Item = CurveMeeting<Q, T, N>> + '_ {
        self.meetings(|event| matches!(event, CurveEvent::JointRange { .. }))
    }

    fn meetings(&self, is_wanted: fn(CurveEvent<N>) -> bool) -> impl Iterator<Item = CurveMeeting<Q, T, N>> + '_ {
        let places = self.points.iter().enumerate();
        let wanted = places.filter(move |(_, point)| point.event.is_some_and(is_wanted));
        wanted.map(|(place, &point)| {
            let (before, after) = (&self.points[..place], &self.points[place + 1..]);
            let is_closed = matches!(self.end, CurveEnd::Closed { .. });
            // A closed motion goes on at its start.
            let [around_before, around_after] = if is_closed { [after, before] } else { [&[][..]; 2] };
            let modes = [
                mode_towards(before.iter().rev().chain(around_before.iter().rev())),
                mode_towards(after.iter().chain(around_after)),
            ];
            CurveMeeting { point, modes }
        })
    }

    /// The least and the largest input.
    #[must_use]
    pub fn range(&self) -> Option<[T; 2]> {
        let inputs = self.points.iter().map(|point| point.input);
        inputs.fold(None, |range, input| {
            let [least, largest] = range.unwrap_or([input; 2]);
            Some([least.min(input), largest.max(input)])
        })
    }

    /// The number of turns of the input after which the motion closes without a dead point; zero if there is none.
    #[must_use]
    pub fn full_turns(&self) -> i32 {
        match self.end {
            CurveEnd::Closed { turns } if self.dead_points().next().is_none() => turns,
            _ => 0,
        }
    }

    /// True if the motion closes without a dead point.
    #[must_use]
    pub fn turns_fully(&self) -> bool {
        self.full_turns() != 0
    }
}

/// The first mode among points, up to a dead point.
fn mode_towards<'a, Q: 'a, T: 'a, N: Copy + 'a>(
    points: impl Iterator<Item = &'a CurvePoint<Q, T, N>>,
) -> Option<usize> {
    let events = points.filter_map(|point| point.event);
    let mut between = events.take_while(|event| !matches!(event, CurveEvent::DeadPoint { .. }));
    between.find_map(|event| if let CurveEvent::Mode(mode) = event { Some(mode) } else { None }).flatten()
}
