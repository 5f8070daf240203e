//! J, A and gamma are the derivatives that dual numbers carry through Psi, to machine precision.

use linkage_oracle::{Oracle, all_close};
use num_dual::{Dual2_64, Dual64};

use crate::intervals::formulas::{At, Enclosable};
use crate::intervals::poses;

/// Relative error of one formula against another.
const TOLERANCE: f64 = 1e-12;

pub fn are_the_derivatives(of: &Enclosable) {
    let oracle = Oracle::of(of);
    oracle.at_samples(poses(), |_, sample| {
        let at = At::of(sample, &oracle.derivation);
        let found = of.values(&at);
        let (u, v) = (at.unknowns.len(), at.inputs.len());
        let (jacobian, rest) = found[u..].split_at(u * (u + v));
        let gamma = &rest[..u];
        let largest = jacobian.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));

        let constant = at.map(Dual64::from_re);
        for (column, entries) in jacobian.chunks(u.max(1)).enumerate() {
            let mut along = constant.map(|value| value);
            let place = along.unknowns.iter_mut().chain(&mut along.inputs).nth(column).unwrap();
            place.eps = 1.0;
            let expected: Vec<f64> = of.residual(&along).iter().map(|psi| psi.eps).collect();
            compare("derivative of Psi", entries, &expected, largest);
        }
        // The second derivative of Psi along q'.
        let mut along = at.map(Dual2_64::from_re);
        let rates = at.unknown_rates.iter().chain(&at.input_rates);
        for (value, &rate) in along.unknowns.iter_mut().chain(&mut along.inputs).zip(rates) {
            value.v1 = rate;
        }
        let expected: Vec<f64> = of.residual(&along).iter().map(|psi| psi.v2).collect();
        compare("gamma", gamma, &expected, 0.0);
    });
}

/// Compares rows without user functions, of whose derivatives nothing is known either.
fn compare(what: &str, found: &[f64], expected: &[f64], scale: f64) {
    let (found, expected): (Vec<f64>, Vec<f64>) =
        found.iter().zip(expected).filter(|(found, expected)| !found.is_nan() && !expected.is_nan()).unzip();
    all_close(what, &found, &expected, scale, TOLERANCE);
}
