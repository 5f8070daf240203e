//! The drivers and the scenes of a mechanism with mistakes.

use crate::graph::NodeId;
use crate::ids::{CoordinateId, DriverId, InputId, Table};
use crate::model::mechanism::{Driver, Mechanism};
use crate::model::scene::{Drive, Scene, SceneRequest};

/// The input of a driver without one: the last coordinate that no driver before it has.
pub(in crate::model) fn driven(before: &[Driver], open: &[CoordinateId]) -> Option<CoordinateId> {
    open.iter().rev().copied().find(|id| before.iter().all(|driver| !driver.inputs.contains(id)))
}

/// The driver of a scene that names none: the first one.
pub(in crate::model) fn driver(mechanism: &Mechanism) -> Option<DriverId> {
    mechanism.drivers.ids().next()
}

/// The drive of a scene that drives only a name that is no input, by this law: that of the first input.
pub(in crate::model) fn drive(
    drives: &[Drive],
    inputs: &Table<InputId, CoordinateId>,
    law: Option<NodeId>,
) -> Option<Drive> {
    let input = inputs.ids().next().filter(|_| drives.is_empty())?;
    law.map(|law| Drive { input, law })
}

/// Completes a scene with mistakes: all that the right scene may have.
pub(in crate::model) fn completed(scene: &mut Scene, mechanism: &Mechanism) {
    scene.inertia.get_or_insert_with(|| mechanism.bodies.ids().collect());
    scene.requests.extend([
        SceneRequest::Energy,
        SceneRequest::Power,
        SceneRequest::Reactions,
        SceneRequest::Equilibrium,
    ]);
}
