//! The loads on the joints over a turn.

use std::f64::consts::{PI, TAU};

use linkage::nalgebra::{Vector2, vector};
use linkage::{Error, Slider};

use crate::machine::{CompressorBranch, Running, RunningReactions, air};

/// The branch of the compressor: the piston is on the side of its head.
pub const BRANCH: CompressorBranch = CompressorBranch { psi_z: Slider::Far };

/// The loads at one crank angle.
#[derive(Debug, Clone, Copy)]
pub struct Loads {
    pub phi: f64,
    /// The pressure in the cylinder, Pa, and the place of the piston pin.
    pub pressure: f64,
    pub place: f64,
    /// The forces in the joints.
    pub joints: RunningReactions,
    /// The torque of the drive.
    pub torque: f64,
    /// The force of the machine on its foundation.
    pub shaking: Vector2<f64>,
}

impl Loads {
    /// # Errors
    /// If the rod is shorter than the crank.
    pub fn at(scene: &Running<f64>, phi: f64) -> Result<Self, Error> {
        let machine = &scene.mechanism;
        let pose = machine.assemble(phi, BRANCH)?;
        let (q, t) = (pose.coordinates(), phi / scene.omega);
        let joints = scene.reactions(t, &q, scene.omega)?;
        let torque = scene.drive_forces(t, &q, scene.omega)?.phi;
        let Running { clearance, inlet, outlet, exponent, .. } = *scene;
        let pressure = air::pressure(phi, machine.r / machine.l, clearance, inlet, outlet, exponent);
        // On the frame act the bearings, the piston on its guide, and the air on the head.
        let air = vector![PI / 4.0 * scene.bore.powi(2) * (pressure - inlet), 0.0];
        let guide = vector![0.0, -joints.z_normal];
        let shaking = joints.bearing_on_ground + joints.shaft_on_ground + guide + air;
        Ok(Self { phi, pressure, place: q.z, joints, torque, shaking })
    }

    /// The loads at `count` equal steps of a turn.
    ///
    /// # Errors
    /// Those of [`at`](Self::at).
    pub fn turn(scene: &Running<f64>, count: u32) -> Result<Vec<Self>, Error> {
        (0..=count).map(|step| Self::at(scene, TAU * f64::from(step) / f64::from(count))).collect()
    }
}
