//! Scenes in motion against exact laws, published figures and the same motion in other coordinates.

mod andrews;
mod backward;
mod car_axis;
mod change_points;
mod contacts;
mod contacts_of_linkages;
mod contacts_over_change_points;
mod dead_points;
mod doors;
mod extremes;
mod failures;
mod held_contacts;
mod impacts;
mod integrals;
mod jumps;
mod kinks;
mod loads;
mod long_runs;
mod no_load;
mod rig;
mod shallow_contacts;
mod stiffness;
mod windows;

use linkage::simulation::{Simulation, State};
use linkage::{MotionErrorOf, Scene};

/// All states to the end, and the error that ended the motion.
fn run<S: Scene<Scalar = f64>>(mut motion: Simulation<'_, S>) -> (Vec<State<S>>, Option<MotionErrorOf<S>>) {
    let mut states = Vec::new();
    let error = motion
        .finish(|state, _| {
            states.push(*state);
            true
        })
        .err();
    (states, error)
}
