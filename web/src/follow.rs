//! Motions to other inputs and to other values of parameters: they are followed, and end where the linkage does.

use linkage_interpreter::Design;
use linkage_runtime::continuation::{AlongCoordinates, Direction, Options, Path};
use linkage_runtime::position::newton;
use linkage_runtime::{Mechanism as _, PathError};

use crate::Refusal;
use crate::at::{Coordinates, Moving, coordinates, moving, one_input, place};
use crate::limit::{Limit, Stop};
use crate::machine::{Machine, prepared};
use crate::picture::joints;
use crate::positions::why_not;
use crate::question::{Aim, At, Place};

/// The most steps of a motion to other inputs.
const MOST_STEPS: usize = 20_000;

/// The distance from the limit at which a motion stops, in radians or in parts of the linkage: at a dead point itself it would
/// not be known on which side it goes on.
const BEFORE: f64 = 1e-6;

/// A motion has already reached its stop where the distance that is left is less than this part of `BEFORE`: such a distance may
/// be a rounding error.
const SAME: f64 = 1e-3;

/// The most steps of a motion to other parameters, and the least part of the way of a step.
const MOST_CHANGES: usize = 2_000;
const LEAST_CHANGE: f64 = 1e-6;

/// The largest change of an unknown in a step, and its largest distance from the line through the last two positions, in radians
/// or in parts of the linkage.
const LARGEST_CHANGE: f64 = 0.3;
const OFF_LINE: f64 = 0.1;

/// A position, and the limit at which the motion to it stopped.
pub type Reached = (At, Option<Stop>);

/// Follows the motion to an aim: first the parameters change, then the inputs one after the other.
pub fn follow(machine: &Machine, at: At, to: &Aim) -> Result<Reached, Refusal> {
    let (mut at, mut stopped) = if at.parameters == to.parameters { (at, None) } else { reshape(machine, at, to)? };
    if stopped.is_none() {
        let design = machine.design(&at.parameters);
        let prepared = prepared(&design)?;
        let mechanism = moving(&prepared)?;
        (at.place, stopped) = drive(&mechanism, &at.place, &to.inputs)?;
    }
    Ok((at, stopped))
}

/// Moves the inputs one after the other.
pub fn drive(mechanism: &Moving<'_>, from: &Place, to: &[f64]) -> Result<(Place, Option<Stop>), Refusal> {
    let mut q = coordinates(mechanism, from)?;
    for (input, &value) in to.iter().enumerate().take(q.inputs.as_slice().len()) {
        if q.inputs[input] == value {
            continue;
        }
        if !value.is_finite() {
            return Err(Refusal::new("an input is no number"));
        }
        let (reached, limit) = drive_one(mechanism, q, input, value)?;
        q = reached;
        if let Some(limit) = limit {
            return Ok((place(&q), Some(Stop { input: Some(input), limit })));
        }
    }
    Ok((place(&q), None))
}

/// Moves one input.
fn drive_one(
    mechanism: &Moving<'_>,
    q: Coordinates,
    input: usize,
    to: f64,
) -> Result<(Coordinates, Option<Limit>), Refusal> {
    let one = one_input(*mechanism, q.inputs.as_slice(), input)?;
    let from = q.inputs[input];
    let start = AlongCoordinates { q, parameter: from };
    let direction = if to > from { Direction::Increasing } else { Direction::Decreasing };
    // The position there; or where the motion ends, and why.
    let reach_by = |to: f64, joint_ranges: bool| -> (Coordinates, Option<PathError<&str>>) {
        let options = Options { most_steps: MOST_STEPS, joint_ranges, ..Options::default() };
        let mut path = match Path::with(&one, &start, direction, options) {
            Ok(path) => path,
            Err(error) => return (q, Some(error)),
        };
        match path.advance_to(to) {
            Ok(step) => (one.position(&step.position), None),
            Err(error) => (one.position(&path.position()), Some(error)),
        }
    };
    let reach = |to: f64| reach_by(to, true);
    // From outside of the declared ranges, as after a change of parameters, a motion may only lead into them.
    let is_within = |q: &Coordinates| mechanism.is_within_ranges(q).unwrap_or_default();
    if !is_within(&q)
        && let (reached, None) = reach_by(to, false)
        && is_within(&reached)
    {
        return Ok((reached, None));
    }
    let (end, error) = reach(to);
    let Some(error) = error else { return Ok((end, None)) };
    let limit = Limit::from(&error).at(mechanism, &end);
    let gap = match &error {
        PathError::DeadPoint { gap, .. } | PathError::JointRange { gap, .. } => *gap,
        _ => return Ok((q, Some(limit))),
    };
    let is_angle = mechanism.input_angles().get(input).copied().unwrap_or_default();
    let scale = if is_angle { 1.0 } else { mechanism.length_scale(&mechanism.pose_at(&q)) };
    let back = (gap + BEFORE * scale).copysign(to - from);
    let last = to - back;
    // Already at the limit.
    let is_ahead = (last - from).signum() == (to - from).signum() && (last - from).abs() > BEFORE * scale * SAME;
    let reached = match is_ahead.then(|| reach(last)) {
        Some((reached, None)) => reached,
        _ => q,
    };
    Ok((reached, Some(limit)))
}

/// Changes the values of parameters. The position goes along: steps are so short that it is near the line through the last two,
/// and that no determinant of a group changes its sign, as it does between two branches.
fn reshape(machine: &Machine, from: At, to: &Aim) -> Result<Reached, Refusal> {
    let stop = |limit| Some(Stop { input: None, limit });
    let Some(mut last) = Shape::of(machine.design(&from.parameters), &from.place)? else {
        return Ok((from, stop(Limit::NoPosition)));
    };
    let (mut before, mut done, mut step) = (None, 0.0, 1.0);
    let mut at = from.clone();
    for _ in 0..MOST_CHANGES {
        let next = if done + step >= 1.0 { 1.0 } else { done + step };
        let between = |(from, to): (&f64, &f64)| if next == 1.0 { *to } else { from + (to - from) * next };
        let parameters: Vec<f64> = from.parameters.iter().zip(&to.parameters).map(between).collect();
        let guess = guess(&last, before.as_ref(), next - done);
        let found = Shape::near(machine.design(&parameters), &guess, &from.place.inputs)?;
        let reached =
            found.and_then(|shape| if shape.continues(&last, &guess) { Ok(shape) } else { Err(Limit::TooNear) });
        match reached {
            Ok(shape) => {
                before = Some((std::mem::replace(&mut last, shape), next - done));
                done = next;
                at = At { parameters, place: last.place.clone(), ..at };
                if done == 1.0 {
                    return Ok((at, None));
                }
                step = (2.0 * step).min(1.0 - done);
            }
            Err(limit) => {
                step /= 2.0;
                if step < LEAST_CHANGE {
                    let there = machine.design(&to.parameters);
                    let why = why_not(&there, &from.place.inputs);
                    let why = why.map(|why| machine.explained(why, &to.parameters));
                    let limit = why.map_or(limit, |Refusal { why, .. }| Limit::Error { why });
                    return Ok((at, stop(limit)));
                }
            }
        }
    }
    Ok((at, stop(Limit::TooLong { steps: MOST_CHANGES })))
}

/// The unknowns on the line through the last two positions.
fn guess(last: &Shape, before: Option<&(Shape, f64)>, step: f64) -> Vec<f64> {
    let here = &last.place.unknowns;
    match before {
        Some((before, length)) => {
            let part = step / length;
            here.iter().zip(&before.place.unknowns).map(|(here, before)| here + (here - before) * part).collect()
        }
        None => here.clone(),
    }
}

/// A position with its own values of parameters.
struct Shape {
    place: Place,
    /// The determinants of its groups.
    determinants: Vec<f64>,
    /// The scale of each unknown: 1 for an angle, the size of the linkage for a length.
    scales: Vec<f64>,
}

impl Shape {
    /// The shape at a position; none if it has no numbers.
    fn of(design: Design, at: &Place) -> Result<Option<Self>, Refusal> {
        let prepared = prepared(&design)?;
        let mechanism = moving(&prepared)?;
        let q = coordinates(&mechanism, at)?;
        Ok(Some(Self::at(&mechanism, &q)).filter(|shape| shape.determinants.iter().all(|one| one.is_finite())))
    }

    /// The shape at the position that Newton's method finds, or why it finds none.
    fn near(design: Design, unknowns: &[f64], inputs: &[f64]) -> Result<Result<Self, Limit>, Refusal> {
        let prepared = prepared(&design)?;
        let mechanism = moving(&prepared)?;
        let guess = Place { inputs: inputs.to_vec(), unknowns: unknowns.to_vec() };
        let found = newton(&mechanism, &coordinates(&mechanism, &guess)?);
        Ok(found
            .map(|found| Self::at(&mechanism, &found.coordinates))
            .map_err(|error| Limit::Error { why: Refusal::of_position(&error).why }))
    }

    fn at(mechanism: &Moving<'_>, q: &Coordinates) -> Self {
        let determinants = mechanism.block_determinants(&mechanism.pose_at(q));
        let size = joints(mechanism, q).iter().fold(0.0, |size: f64, joint| size.max(joint.x.abs()).max(joint.y.abs()));
        let size = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let scales = mechanism.unknown_angles().iter().map(|is_angle| if *is_angle { 1.0 } else { size });
        Self { place: place(q), determinants: determinants.as_slice().to_vec(), scales: scales.collect() }
    }

    /// True if it goes on from another one, near a guess.
    fn continues(&self, from: &Self, guess: &[f64]) -> bool {
        let far = |others: &[f64]| {
            let each = self.place.unknowns.iter().zip(others).zip(&self.scales);
            each.fold(0.0, |far: f64, ((one, other), scale)| far.max((one - other).abs() / scale))
        };
        let same = |(one, other): (&f64, &f64)| one.signum() == other.signum();
        far(&from.place.unknowns) <= LARGEST_CHANGE
            && far(guess) <= OFF_LINE
            && self.determinants.iter().zip(&from.determinants).all(same)
    }
}
