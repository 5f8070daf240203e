//! The joint forces.

use linkage::nalgebra::Vector2;
use linkage::{ContactLaw, Error};

use super::machine::Running;
use super::run::Moment;

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

        let joints = scene.reactions(*t, q, rates.phi)?;
        Ok(Self {
            phi: q.phi,
            // The gas acts on the pin: what the rod does not take, the piston takes.
            piston_pin: -joints.piston_on_rod,
            crank_pin: joints.pin_on_rod,
            bearing: joints.bearing_on_crank,
            side: -joints.z_normal,
            torque: scene.flywheel * acceleration + scene.brake * rates.phi,
            drag,
            acceleration,
        })
    }
}
