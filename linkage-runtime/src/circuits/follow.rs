//! The motion of a mode, followed until it closes.

use std::vec::Vec;

use super::modes::{Modes, crossing_function};
use super::motion::{CurveEnd, CurveEvent, CurvePoint, MotionCurve};
use super::{CircuitError, CircuitOptions};
use crate::continuation::{Direction, Event, Options, Path, TouchOnPath, Touches};
use crate::same_position::has_counted;
use crate::scalar::arithmetic::*;
use crate::scalar::to_f64;
use crate::{Branches, D, Mechanism, PathError, PathErrorOf, real};

/// The points of a motion.
type Points<M> = Vec<CurvePoint<<M as Mechanism>::Coordinates, <M as Mechanism>::Scalar, <M as Mechanism>::Name>>;

/// A motion of a mechanism.
type CurveOf<M> = MotionCurve<<M as Mechanism>::Coordinates, <M as Mechanism>::Scalar, <M as Mechanism>::Name>;

/// Follows modes of one mechanism.
pub(super) struct Follower<'a, M: Branches> {
    mechanism: &'a M,
    modes: &'a Modes<'a, M>,
    options: Options<M::Scalar>,
    /// The largest way of a coordinate from the start.
    most: M::Scalar,
}

impl<'a, M: Branches<V = D<1>>> Follower<'a, M> {
    pub(super) fn new(mechanism: &'a M, modes: &'a Modes<'a, M>, options: &CircuitOptions<M::Scalar>) -> Self {
        let mut path = options.path;
        // A path does not look for a start input in the step after one: no step is as long as a gap between them.
        for (place, &input) in modes.inputs.iter().enumerate() {
            for &other in &modes.inputs[..place] {
                path.longest_step = path.longest_step.min(modes.input_gap(input, other).abs() * real(0.5));
            }
        }
        let most = M::Scalar::two_pi() * real(f64::from(options.most_turns));
        Self { mechanism, modes, options: path, most }
    }

    /// The motion of a mode.
    pub(super) fn motion(&self, mode: usize) -> Result<CurveOf<M>, CircuitError<M::Name>> {
        let follow = |direction| self.travel(mode, direction).map_err(|error| CircuitError::Path { mode, error });
        let (mut points, end) = follow(Direction::Increasing)?;
        if !matches!(end, CurveEnd::Closed { .. }) {
            // The other side of the start; the start is in both.
            let (other_side, _) = follow(Direction::Decreasing)?;
            points.splice(..1, other_side.into_iter().rev());
        }
        Ok(MotionCurve { points, end })
    }

    /// The points from a mode in a direction, until the motion closes or ends.
    fn travel(&self, mode: usize, direction: Direction<M::Rates>) -> Result<(Points<M>, CurveEnd), PathErrorOf<M>> {
        let start = self.modes.positions[mode];
        let mut path = Path::with(self.mechanism, &start, direction, self.options)?;
        let mut points = vec![point::<M>(start, Some(CurveEvent::Mode(Some(mode))))];
        let mut touches = Touches::new(&path);
        for _ in 0..self.options.most_steps {
            let step = path.advance_watching(|q, _| crossing_function(self.modes, q))?;
            let last = points.len() - 1;
            insert(&mut points, last, touches.after_step(&path)?);
            let event = match step.event {
                Some(Event::Zero) => Some(CurveEvent::Mode(self.modes.find(&step.position))),
                Some(Event::DeadPoint { group }) => Some(CurveEvent::DeadPoint { group }),
                Some(Event::ChangePoint { groups, .. }) => Some(CurveEvent::ChangePoint { group: groups.first() }),
                Some(Event::JointRange { of, end }) => Some(CurveEvent::JointRange { of, end }),
                Some(Event::Limit) | None => None,
            };
            let is_at_start = event == Some(CurveEvent::Mode(Some(mode)));
            let is_closed = is_at_start && !has_counted(self.mechanism, &step.position, &start);
            points.push(point::<M>(step.position, event.filter(|_| !is_closed)));
            let end = if is_closed {
                CurveEnd::Closed { turns: turns::<M>(self.mechanism, &start, &step.position) }
            } else if matches!(step.event, Some(Event::Limit | Event::JointRange { .. })) {
                CurveEnd::Limits
            } else if self.modes.way(&step.position, &start) > self.most {
                CurveEnd::Open
            } else {
                continue;
            };
            let last = points.len() - 1;
            insert(&mut points, last, touches.at_end(&path)?);
            return Ok((points, end));
        }
        Err(PathError::TooManySteps { mechanism: self.mechanism.name(), steps: self.options.most_steps })
    }
}

/// Inserts a touch before or after the point at this place.
fn insert<M: Mechanism<V = D<1>>>(points: &mut Points<M>, place: usize, touch: Option<TouchOnPath<M>>) {
    if let Some(TouchOnPath { position, groups, is_before }) = touch {
        let event = CurveEvent::ChangePoint { group: groups.first() };
        points.insert(if is_before { place } else { place + 1 }, point::<M>(position, Some(event)));
    }
}

fn point<M: Mechanism<V = D<1>>>(
    position: M::Coordinates,
    event: Option<CurveEvent<M::Name>>,
) -> CurvePoint<M::Coordinates, M::Scalar, M::Name> {
    CurvePoint { input: M::inputs(&position)[0], position, event }
}

/// The whole turns of the input from one position to another.
fn turns<M: Mechanism<V = D<1>>>(mechanism: &M, from: &M::Coordinates, to: &M::Coordinates) -> i32 {
    let turned = (M::inputs(to)[0] - M::inputs(from)[0]) / M::Scalar::two_pi();
    // At most `most_turns`.
    if mechanism.input_angles()[0] { to_f64(turned.round()) as i32 } else { 0 }
}
