//! Work of the gas and heat of the rings between two crank angles, from the laws alone.

use std::f64::consts::PI;

use linkage::{Error, Slider};

use super::machine::{CYCLE, EngineBranch, KINKS, Running};
use crate::quadrature::nodes;

/// The work of the gas (integral of p dV) and the heat of the rings (integral of friction times distance).
///
/// # Errors
/// If a position cannot be assembled: the rod is shorter than the crank.
pub fn work(scene: &Running<f64>, [from, to]: [f64; 2]) -> Result<[f64; 2], Error> {
    let engine = &scene.mechanism;
    let mut ends = vec![from, to];
    // Interval ends: the kinks of the laws, and the dead centres.
    for kink in KINKS.map(f64::to_radians).into_iter().chain([0.0, PI, 2.0 * PI, 3.0 * PI]) {
        let first = ((from - kink) / CYCLE).ceil();
        ends.extend((0..).map(|count| kink + (first + f64::from(count)) * CYCLE).take_while(|place| *place < to));
    }
    ends.sort_by(f64::total_cmp);
    let mut work = [0.0, 0.0];
    for pair in ends.windows(2) {
        let parts = ((pair[1] - pair[0]) / 0.2).ceil();
        let place = |part: u32| pair[0] + (pair[1] - pair[0]) * f64::from(part) / parts;
        for part in 0..parts as u32 {
            for [phi, weight] in nodes([place(part), place(part + 1)]) {
                let pose = engine.assemble(phi, EngineBranch { psi_z: Slider::Far })?;
                let rate = engine.velocity(&pose, 1.0)?;
                let outputs = engine.outputs(&pose)?;
                work[0] += weight * (outputs.pressure - scene.ambient) * -rate.z * PI / 4.0 * engine.bore.powi(2);
                work[1] += weight * scene.mu * (scene.tension + scene.face * outputs.pressure) * rate.z.abs();
            }
        }
    }
    Ok(work)
}
