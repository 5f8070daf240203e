//! The ride over time, and the account of its energy.

use linkage::Error;
use linkage::simulation::{Start, State, simulate};

use crate::quadrature::nodes;
use linkage_gallery::car_axis::{CarAxisInputs, Riding};
use linkage_gallery::car_axis_motion::{END_TIME, START, START_RATES};

/// The relative tolerance of a step.
const TOLERANCE: f64 = 1e-12;

/// The ride from start to end.
pub struct Ride {
    pub scene: Riding,
    /// The states in order, several in each step.
    pub moments: Vec<State<Riding>>,
    /// The torque of the bumps on the axis at each of them.
    pub torques: Vec<f64>,
    /// The least and the largest kinetic plus potential energy of the ride.
    pub energies: [f64; 2],
    /// The energy that the ride gains, and the work of the bumps by Gauss quadrature within each step.
    pub balance: [f64; 2],
}

impl Ride {
    /// Rides over the bumps.
    ///
    /// # Errors
    /// Those of the simulation.
    pub fn new(scene: Riding) -> Result<Self, Error> {
        let energy = |state: &State<Riding>| -> Result<f64, Error> {
            let energy = scene.energy(&state.q, CarAxisInputs::from(&state.rates))?;
            Ok(energy.kinetic + energy.potential)
        };
        let torque = |state: &State<Riding>| -> Result<f64, Error> {
            Ok(scene.drive_forces(state.t, &state.q, CarAxisInputs::from(&state.rates))?.beta)
        };
        let start = Start { t: 0.0, q: START, input_rates: START_RATES };
        let mut motion = simulate(&scene, start, END_TIME, TOLERANCE)?;
        let first = *motion.state();
        let (mut last, mut work) = (first, 0.0);
        let (mut moments, mut torques) = (vec![first], vec![torque(&first)?]);
        while let Some(state) = motion.advance()? {
            let nodes = nodes([last.t, state.t]);
            for (node, [_, weight]) in motion.at(nodes.map(|[t, _]| t)).zip(nodes) {
                let node = node?;
                let turning = torque(&node)?;
                work += weight * turning * node.rates.beta;
                moments.push(node);
                torques.push(turning);
            }
            moments.push(state);
            torques.push(torque(&state)?);
            last = state;
        }
        let all = moments.iter().map(energy).collect::<Result<Vec<_>, _>>()?;
        let energies =
            all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], &at| [least.min(at), most.max(at)]);
        let balance = [energy(&last)? - energy(&first)?, work];
        Ok(Self { scene, moments, torques, energies, balance })
    }
}
