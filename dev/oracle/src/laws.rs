//! The cam laws behind user functions.

use linkage_compiler::graph::External;
use linkage_compiler::model::Mechanism;
use linkage_gallery::cam_laws;

/// The values that a law gives at these arguments: itself and its derivatives.
pub fn values(mechanism: &Mechanism, external: &External, arguments: &[f64]) -> Vec<f64> {
    let path = &mechanism.externals[external.function.index()].path;
    let &[angle, height, rise] = arguments else { panic!("a cam law takes an angle, a height and a rise") };
    match path.segments.last().expect("a path").ident.to_string().as_str() {
        "cycloidal_strokes" => <[f64; 3]>::from(cam_laws::cycloidal_strokes(angle, height, rise)).to_vec(),
        "polynomial_strokes" => <[f64; 4]>::from(cam_laws::polynomial_strokes(angle, height, rise)).to_vec(),
        other => panic!("no cam law is called {other}"),
    }
}
