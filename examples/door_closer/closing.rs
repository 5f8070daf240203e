//! The door in motion, and where its energy goes.

use linkage::contact::Change;
use linkage::simulation::{State, simulate};
use linkage::{Elbow, Error};

use crate::gauss::nodes;
use crate::machine::{Closing, DoorCloserBranch, DoorCloserCoordinates, DoorCloserInputs};

pub type Moment = State<Closing>;

/// The relative error allowed of a step.
const TOLERANCE: f64 = 1e-12;

/// Longer than it takes to close, in seconds.
pub const END: f64 = 6.0;

/// From where the door is let go until it rests.
pub struct Run {
    pub scene: Closing<f64>,
    /// In order, several in each step; at an impact as it was before.
    pub moments: Vec<Moment>,
    /// Kinetic and potential energy at each of them.
    pub energies: Vec<f64>,
    /// Where the door hits its frame; at the last it comes to rest there.
    pub impacts: Vec<Moment>,
    /// What the damper has taken: its power by Gauss's quadrature within each step.
    pub oil: f64,
    /// What the impacts have taken.
    pub blows: f64,
}

impl Run {
    /// Let go at this angle, at rest.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn new(scene: Closing<f64>, angle: f64) -> Result<Self, Error> {
        let start = scene.mechanism.assemble(angle, DoorCloserBranch::new(Elbow::Left))?.coordinates();
        let energy = |q: &DoorCloserCoordinates<f64>, rate: f64| -> Result<f64, Error> {
            let energy = scene.energy(q, DoorCloserInputs { door: rate })?;
            Ok(energy.kinetic + energy.potential)
        };
        let mut motion = simulate(&scene, (0.0, start, 0.0), END, TOLERANCE)?;
        let mut last = *motion.state();
        let (mut moments, mut impacts, mut oil, mut blows) = (vec![last], Vec::new(), 0.0, 0.0);
        while let Some(state) = motion.advance()? {
            let nodes = nodes([last.t, state.t]);
            for (state, [_, weight]) in motion.at(nodes.map(|[t, _]| t)).zip(nodes) {
                let state = state?;
                oil += weight * scene.power(state.t, &state.q, state.rates.door)?.dissipated;
                moments.push(state);
            }
            moments.push(state);
            for (_, change) in state.changes() {
                let before = energy(&state.q, state.rates.door)?;
                let rebound = if change == Change::Impact { scene.restitution * state.rates.door } else { 0.0 };
                blows += before - energy(&state.q, rebound)?;
                impacts.push(state);
            }
            last = state;
        }
        let energies = moments.iter().map(|state| energy(&state.q, state.rates.door)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { scene, moments, energies, impacts, oil, blows })
    }
}
