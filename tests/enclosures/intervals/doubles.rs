//! In doubles the formulas are those that the mechanism computes from a position.

use linkage::{Certifiable, Dim, Matrix, Mechanism};
use linkage_gallery::{Fixture, Kinematics};
use linkage_oracle::Oracle;

use crate::intervals::formulas::{At, column, is_known, nodes, title, values};
use crate::intervals::poses;

/// Most ulps of the sum of the magnitudes of the terms: the two programs round in an order of their own, in the arguments
/// of sines too.
const ULPS: f64 = 64.0;

pub fn are_those_of_a_position<F: Fixture + Certifiable>() {
    let mut oracle = Oracle::of::<F>();
    let nodes = nodes(&mut oracle);
    let known = is_known(&oracle, &nodes);
    let mut compared = 0;
    for sample in oracle.samples(poses()) {
        let at = At::of(&sample, &oracle.derivation);
        let found = values::<F, f64>(&at);
        let expected = of_position(&F::with_parameters(&sample.parameters), &at);
        let sizes = oracle.magnitudes(&sample, &nodes);
        assert_eq!(found.len(), expected.len(), "{}", title::<F>());
        for (place, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
            if !known[place] {
                assert!(found.is_nan(), "{}: number {place} depends on a user function", title::<F>());
                continue;
            }
            let error = ULPS * f64::EPSILON * sizes[place];
            assert!((found - expected).abs() <= error, "{}: number {place} is {found}, not {expected}", title::<F>());
            compared += 1;
        }
    }
    assert!(compared > 0, "{}", title::<F>());
}

/// The numbers in the order of `values`, from the functions of a position.
fn of_position<F: Fixture>(mechanism: &F, at: &At<f64>) -> Vec<f64> {
    let pose = mechanism.pose_at(&F::coordinates(column(&at.unknowns), column(&at.inputs)));
    let rates = <F as Mechanism>::rates(column(&at.unknown_rates), column(&at.input_rates));
    let mut all: Vec<f64> = Mechanism::residual(mechanism, &pose).into_iter().collect();
    all.extend(entries(&mechanism.jacobian_unknowns(&pose)));
    all.extend(entries(&mechanism.jacobian_inputs(&pose)));
    all.extend(Mechanism::gamma(mechanism, &pose, &rates));
    all.extend(Kinematics::points(mechanism, &pose).unwrap());
    all.extend(Kinematics::outputs(mechanism, &pose).unwrap());
    all
}

fn entries<R: Dim, C: Dim>(matrix: &Matrix<f64, R, C>) -> Vec<f64> {
    matrix.columns().iter().flatten().copied().collect()
}
