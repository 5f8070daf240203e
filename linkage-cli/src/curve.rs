//! A motion of a circuit with its events, by numbers from 1.

use linkage_runtime::Mechanism;
use linkage_runtime::circuits::{CurveEnd, CurveEvent, CurveMeeting, MotionCurve};
use serde::Serialize;

use crate::ends::{Reason, shown};
use crate::one_input::{At, OneInput};

/// A motion of a circuit.
#[derive(Serialize)]
pub struct Motion {
    least: f64,
    largest: f64,
    kind: Kind,
    /// The turns of the input after which the motion is at its start again.
    turns: u32,
    /// The positions that it passes, in the order of travel.
    pub positions: Vec<usize>,
    /// Dead points, change points and ends, in the order of travel.
    pub events: Vec<Event>,
}

/// The way of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    /// The input turns in one direction.
    Turns,
    /// The input goes to and fro.
    ToAndFro,
    /// It ends at ends of ranges.
    Ends,
    /// It does not close.
    Open,
}

/// An event of a motion.
#[derive(Serialize)]
pub struct Event {
    input: f64,
    #[serde(flatten)]
    reason: Reason,
    unknowns: Vec<f64>,
    /// The positions passed last before and first after it.
    positions: [Option<usize>; 2],
}

impl Motion {
    pub fn of(curve: &MotionCurve<At, f64, &str>) -> Self {
        let all = curve.dead_points().chain(curve.change_points()).chain(curve.joint_ranges());
        let place = |event: &CurveMeeting<At, f64, &str>| curve.points.iter().position(|point| *point == event.point);
        let mut events: Vec<_> = all.collect();
        events.sort_by_key(place);
        let has_dead_points = curve.dead_points().next().is_some();
        let (kind, turns) = match curve.end {
            CurveEnd::Closed { turns: 0 } => (Kind::ToAndFro, 0),
            CurveEnd::Closed { .. } if has_dead_points => (Kind::ToAndFro, 0),
            CurveEnd::Closed { turns } => (Kind::Turns, turns.unsigned_abs()),
            CurveEnd::Limits => (Kind::Ends, 0),
            CurveEnd::Open => (Kind::Open, 0),
        };
        let [least, largest] = curve.range().unwrap_or([f64::NAN; 2]);
        let mut positions: Vec<usize> = curve.modes().map(|mode| mode + 1).collect();
        // A closed motion passes its first position at its end again.
        positions.dedup();
        Self { least, largest, kind, turns, positions, events: events.iter().map(Event::of).collect() }
    }

    /// The motion with the reasons of its events where these groups are singular, by the input and the unknowns.
    pub fn where_singular<E>(mut self, groups: impl Fn(f64, &[f64]) -> Result<Vec<String>, E>) -> Result<Self, E> {
        for event in &mut self.events {
            let reason = event.reason.clone();
            event.reason = reason.where_singular(&groups(event.input, &event.unknowns)?);
        }
        Ok(self)
    }

    /// The range of the input.
    pub fn in_words(&self, input: &str, is_angle: bool) -> String {
        let [least, largest] = [self.least, self.largest].map(|end| shown(end, is_angle));
        match (self.kind, self.turns) {
            (Kind::Turns, 1) => format!("{input} turns fully"),
            (Kind::Turns, turns) => format!("{input} turns fully; the motion closes after {turns} turns"),
            (Kind::ToAndFro, _) => format!("{input} goes to and fro between {least} and {largest}"),
            (Kind::Ends, _) => format!("{input} from {least} to {largest}, at the ends of ranges"),
            (Kind::Open, _) => format!("{input} from {least} to {largest} and on: the motion does not close"),
        }
    }
}

impl Event {
    fn of(meeting: &CurveMeeting<At, f64, &str>) -> Self {
        let group = |group: &str| group.to_owned();
        let reason = match meeting.point.event {
            Some(CurveEvent::DeadPoint { group: of }) => Reason::DeadPoint { group: group(of) },
            Some(CurveEvent::ChangePoint { group: of }) => Reason::ChangePoint { group: group(of) },
            Some(CurveEvent::JointRange { of, end }) => Reason::range(of, end),
            Some(CurveEvent::Mode(_)) | None => Reason::GoesOn,
        };
        Self {
            input: meeting.point.input,
            reason,
            unknowns: OneInput::unknowns(&meeting.point.position).iter().copied().collect(),
            positions: meeting.modes.map(|mode| mode.map(|mode| mode + 1)),
        }
    }

    pub fn in_words(&self, input: &str, is_angle: bool) -> String {
        let at = format!("{} at {input} = {}", self.reason.in_words(), shown(self.input, is_angle));
        match (&self.reason, self.positions) {
            (Reason::DeadPoint { .. }, [Some(one), Some(other)]) if one != other => {
                format!("{at}, where positions {one} and {other} meet")
            }
            _ => at,
        }
    }
}
