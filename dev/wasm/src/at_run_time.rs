//! The mechanisms and scenes of the gallery at run time, compiled on the target.

use linkage_gallery::FILES;
use linkage_interpreter::{Data, Mechanism};

use crate::checksum::Checksum;
use crate::drawn::Drawn;
use crate::gallery::mechanisms;

/// Calls of each function at plain, extreme and nearly singular arguments.
const CALLS: [u64; 3] = [3, 1, 1];

/// Functions that scenes have, most of them not all.
const OF_SCENES: [&str; 9] =
    ["acceleration", "mass_matrix", "forces", "energy", "power", "drives", "drive_forces", "equations", "reactions"];

/// Adds the results of all functions of a file's mechanisms and scenes; returns its name.
pub fn computed(place: usize, sum: &mut Checksum) -> String {
    for mechanism in mechanisms(FILES[place]) {
        let [plain, extreme, near_zero] = CALLS.map(|count| 0..count);
        let plain = plain.map(|seed| Drawn::new(seed, 0.0));
        let extreme = extreme.map(|seed| Drawn::new(seed, 0.1));
        for drawn in plain.chain(extreme).chain(near_zero.map(|seed| Drawn::near_zero(seed, 0.8))) {
            called(&mechanism, drawn, sum);
        }
    }
    format!("at run time {}", FILES[place])
}

fn called(mechanism: &Mechanism, mut drawn: Drawn, sum: &mut Checksum) {
    let parameters: Vec<f64> = mechanism.design().parameters().iter().map(|value| drawn.near(*value)).collect();
    let design = mechanism.design().with_parameters(&parameters);
    for function in mechanism.functions() {
        let arguments = design.arguments(function).expect("a function of its own");
        let arguments: Vec<Data> = arguments.iter().map(|of| drawn.argument(mechanism, &design, &of.shape)).collect();
        sum.add(&design.call(function, &arguments));
    }
    for name in mechanism.scenes() {
        let scene = design.scene(name).expect("a scene of its own");
        let own: Vec<f64> = scene.parameters().iter().skip(parameters.len()).map(|_| drawn.size()).collect();
        let scene = scene.with_parameters(&own);
        for function in OF_SCENES {
            let Ok(arguments) = scene.arguments(function) else { continue };
            let arguments: Vec<Data> =
                arguments.iter().map(|of| drawn.argument(mechanism, &design, &of.shape)).collect();
            sum.add(&scene.call(function, &arguments));
        }
    }
}
