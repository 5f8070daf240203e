//! In doubles the formulas are those that the mechanism computes from a position.

use linkage_gallery::listed::Listed;
use linkage_oracle::{Oracle, Sample};

use crate::intervals::formulas::{At, Enclosable, is_known, nodes};
use crate::intervals::poses;

/// Most ulps of the sum of the magnitudes of the terms: the two programs round in an order of their own, in the arguments
/// of sines too.
const ULPS: f64 = 64.0;

pub fn are_those_of_a_position(of: &Enclosable, emitted: &dyn Listed<f64>) {
    let mut oracle = Oracle::of(of);
    let nodes = nodes(&mut oracle);
    let known = is_known(&oracle, &nodes);
    let mut compared = 0;
    oracle.at_samples(poses(), |_, sample| {
        let found = of.values(&At::of(sample, &oracle.derivation));
        let expected = of_position(emitted, sample);
        let sizes = oracle.magnitudes(sample, &nodes);
        assert_eq!(found.len(), expected.len());
        for (place, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
            if !known[place] {
                assert!(found.is_nan(), "number {place} depends on a user function");
                continue;
            }
            let error = ULPS * f64::EPSILON * sizes[place];
            assert!((found - expected).abs() <= error, "number {place} is {found}, not {expected}");
            compared += 1;
        }
    });
    assert!(compared > 0);
}

/// The numbers of the formulas, from the functions of a position.
fn of_position(emitted: &dyn Listed<f64>, Sample { parameters, q, rates, .. }: &Sample) -> Vec<f64> {
    let pose = emitted.with_parameters(parameters).pose(q);
    let mut all = pose.residual();
    all.extend(pose.jacobian_unknowns().iter().chain(pose.jacobian_inputs().iter()));
    all.extend(pose.gamma(rates));
    all.extend(pose.points().unwrap());
    all.extend(pose.outputs().unwrap());
    all
}
