//! Motions by a pointer: the input follows it.

use std::f64::consts::{PI, TAU};

use linkage_runtime::skeleton::{Part, Skeleton as _};
use linkage_runtime::{Kinematic as _, Mechanism as _};

use crate::Refusal;
use crate::at::{Coordinates, Moving, coordinates, inputs_of, rates};
use crate::follow::drive;
use crate::limit::Stop;
use crate::picture::joints;
use crate::question::Place;

/// The most steps of a motion to a pointer; each is about as good as a frame of the picture.
const MOST_STEPS: u32 = 8;

/// The largest change of the input in a step, in radians or in parts of the linkage.
const LARGEST: f64 = 0.5;

/// The end of the steps, in parts of the distance at the start.
const NEAR: f64 = 1e-3;

/// Moves an input so that a joint comes near a place, by steps of Gauss and Newton along its path; the motion is followed, and
/// stops where it ends.
pub fn drag(
    mechanism: &Moving<'_>,
    from: &Place,
    along: usize,
    joint: &str,
    to: [f64; 2],
) -> Result<(Place, Option<Stop>), Refusal> {
    let mut place = from.clone();
    let mut last = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let q = coordinates(mechanism, &place)?;
        let Some(change) = change(mechanism, &q, along, joint, to)? else { break };
        if change.abs() <= NEAR * LARGEST || change.abs() >= last {
            break;
        }
        last = change.abs();
        let mut inputs = place.inputs.clone();
        inputs[along] += change;
        let (reached, stopped) = drive(mechanism, &place, &inputs)?;
        place = reached;
        if stopped.is_some() {
            return Ok((place, stopped));
        }
    }
    Ok((place, None))
}

/// The change of the input that brings the joint near a place; none if the joint rests.
fn change(
    mechanism: &Moving<'_>,
    q: &Coordinates,
    along: usize,
    joint: &str,
    to: [f64; 2],
) -> Result<Option<f64>, Refusal> {
    let all = joints(mechanism, q);
    let place = all.iter().position(|one| one.name == joint).ok_or_else(|| Refusal::new("there is no such joint"))?;
    let here = [all[place].x, all[place].y];
    // Around a pivot the input follows the angle of the pointer itself.
    if mechanism.input_angles().get(along).copied().unwrap_or_default()
        && let Some(pivot) = pivot(mechanism, place)
    {
        let pivot = [all[pivot].x, all[pivot].y];
        let angle = |at: [f64; 2]| (at[1] - pivot[1]).atan2(at[0] - pivot[0]);
        let turn = angle(to) - angle(here);
        return Ok(Some(turn - TAU * ((turn + PI) / TAU).floor()));
    }
    let pose = mechanism.pose_at(q);
    let Ok(motion) = mechanism.velocity(&pose, rates(mechanism, along, 1.0)) else { return Ok(None) };
    // The velocity of a joint by a central difference along the motion: joints have no formulas of their own for it.
    let size = all.iter().fold(0.0, |size: f64, one| size.max(one.x.abs()).max(one.y.abs()));
    let step = f64::EPSILON.cbrt();
    let moved = |by: f64| -> Result<[f64; 2], Refusal> {
        let mut inputs = q.inputs;
        inputs[along] += by;
        let q = Coordinates {
            unknowns: q.unknowns + motion.unknowns * by,
            inputs: inputs_of(mechanism, inputs.as_slice())?,
        };
        let all = joints(mechanism, &q);
        Ok([all[place].x, all[place].y])
    };
    let ([ahead_x, ahead_y], [back_x, back_y]) = (moved(step)?, moved(-step)?);
    let velocity = [(ahead_x - back_x) / (2.0 * step), (ahead_y - back_y) / (2.0 * step)];
    let square = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    if square.sqrt() <= step * size || !square.is_finite() {
        return Ok(None);
    }
    let change = ((to[0] - here[0]) * velocity[0] + (to[1] - here[1]) * velocity[1]) / square;
    Ok(Some(change.clamp(-LARGEST, LARGEST)))
}

/// The pivot on the ground of the driven link with this joint.
fn pivot(mechanism: &Moving<'_>, joint: usize) -> Option<usize> {
    mechanism.drawn_parts().iter().find_map(|part| match part {
        Part::Bar { joints, is_driven: true } if joints.contains(&joint) => {
            joints.first().copied().filter(|pivot| *pivot != joint)
        }
        _ => None,
    })
}
