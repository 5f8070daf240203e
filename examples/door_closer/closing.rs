//! Simulates the door and its energy balance.

use linkage::contact::Change;
use linkage::simulation::{Start, State, simulate};
use linkage::{Elbow, Error};

use super::machine::{Closing, DoorCloserBranch, DoorCloserCoordinates, DoorCloserInputs};
use crate::quadrature::nodes;

pub type Moment = State<Closing>;

/// The relative tolerance of a step.
const TOLERANCE: f64 = 1e-12;

/// The end of the simulation in seconds, after the door has closed.
pub const END: f64 = 6.0;

/// The motion from the release of the door until it rests.
pub struct Run {
    pub scene: Closing<f64>,
    /// The states in order, several in each step; at an impact, the state before it.
    pub moments: Vec<Moment>,
    /// Kinetic plus potential energy at each of them.
    pub energies: Vec<f64>,
    /// The impacts on the door frame; at the last one the door comes to rest.
    pub impacts: Vec<Moment>,
    /// The energy dissipated by the damper, by Gauss quadrature of its power within each step.
    pub oil: f64,
    /// The energy dissipated by the impacts.
    pub blows: f64,
}

impl Run {
    /// Simulates the door, released at rest at this angle.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn new(scene: Closing<f64>, angle: f64) -> Result<Self, Error> {
        let start = scene.mechanism.assemble(angle, DoorCloserBranch::new(Elbow::Left))?.coordinates();
        let energy = |q: &DoorCloserCoordinates<f64>, rate: f64| -> Result<f64, Error> {
            let energy = scene.energy(q, DoorCloserInputs { door: rate })?;
            Ok(energy.kinetic + energy.potential)
        };
        let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 0.0 }, END, TOLERANCE)?;
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
