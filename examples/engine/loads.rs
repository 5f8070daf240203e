//! The joint forces.

use linkage::nalgebra::{Vector2, vector};
use linkage::{ContactLaw, Error};

use crate::machine::{Engine, Measured, Running};
use crate::run::Moment;

/// Forces in newtons and torques in newton metres at one time; x along the cylinder.
#[derive(Debug, Clone, Copy)]
pub struct Loads {
    pub phi: f64,
    /// The force of the rod on the piston.
    pub piston_pin: Vector2<f64>,
    /// The force of the crank on the rod.
    pub crank_pin: Vector2<f64>,
    /// The force of the main bearing on the crank.
    pub bearing: Vector2<f64>,
    /// The side force of the piston on the cylinder.
    pub side: f64,
    /// The torque of the crank on the flywheel.
    pub torque: f64,
    /// The friction force of the cylinder on the rings, along x.
    pub drag: f64,
    /// The angular acceleration of the crank.
    pub acceleration: f64,
}

impl Loads {
    /// # Errors
    /// Those of the scenes.
    pub fn at(scene: &Running<f64>, Moment { t, q, rates, .. }: &Moment) -> Result<Self, Error> {
        let [rings] = scene.contacts(*t, q, rates)?;
        let ContactLaw::Friction { limit } = rings.law else { unreachable!("the only contact is a friction") };
        let drag = if rates.z > 0.0 { -limit } else { limit };
        // M phi'' = Q + friction force times its velocity ratio.
        let lever = rates.z / rates.phi;
        let mass = scene.mass_matrix(q)?[0];
        let acceleration = (scene.forces(*t, q, rates.phi)?[0] + drag * lever) / mass;

        let Running { g, .. } = *scene;
        let measured = Measured {
            mechanism: scene.mechanism.clone(),
            place: q.phi,
            speed: rates.phi,
            gain: acceleration,
            drag,
            g,
            ..Measured::default()
        };
        let piston_pin = measured.reactions(0.0, q, rates.phi)?;
        let [holding] = measured.drive_forces(0.0, q, rates.phi)?;

        // Newton's law for rod and crank.
        let m: &Engine<f64> = &scene.mechanism;
        let pose = m.pose_at(q);
        let velocity = m.velocity(&pose, rates.phi)?;
        let points = m.point_accelerations(&pose, &velocity, &m.acceleration(&pose, &velocity, acceleration)?)?;
        let weight = vector![-g, 0.0];
        let crank_pin = (points.rod - weight) * scene.m3 + piston_pin;
        let bearing = (points.crank - weight) * scene.m2 + crank_pin;
        Ok(Self {
            phi: q.phi,
            piston_pin,
            crank_pin,
            bearing,
            side: piston_pin.y,
            torque: -holding,
            drag,
            acceleration,
        })
    }
}
