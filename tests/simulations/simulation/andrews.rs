//! Andrews' squeezing mechanism: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem Solvers", release 2.4
//! (2008), problem "andrews"; the constants are those of the scene.

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{Start, State, simulate};

use linkage_gallery::andrews_motion::{END, START};
use linkage_gallery::andrews_scene::*;

/// The rates at that time, computed with the angles.
const END_RATES: SqueezerRates = SqueezerRates {
    beta: 1_139.920_302_259_106,
    theta: -1_424.379_295_177_54,
    gamma: 11.032_911_910_618_594,
    phi: 19.293_374_105_032_04,
    delta: 0.573_569_914_829_502_4,
    omega: -19.293_374_105_032_04,
    epsilon: 0.323_179_149_249_130_9,
};

/// The largest relative errors of positions and rates, and the evaluations they took.
fn errors<M: Method>(tolerance: f64) -> ([f64; 2], usize) {
    let scene = Squeezing::default();
    let mut motion =
        simulate(&scene, Start { t: 0.0, q: START, input_rates: 0.0 }, 0.03, tolerance).unwrap().method::<M>().unwrap();
    motion.finish(|_, _| true).unwrap();
    let State { q, rates, t, .. } = *motion.state();
    assert_eq!(t, 0.03);
    let all = |q: SqueezerCoordinates<f64>| [q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon];
    let all_rates = |q: SqueezerRates<f64>| [q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon];
    let mut errors = [0.0_f64; 2];
    for (worst, [found, expected]) in
        errors.iter_mut().zip([[all(q), all(END)], [all_rates(rates), all_rates(END_RATES)]])
    {
        for (found, expected) in found.into_iter().zip(expected) {
            *worst = worst.max((found / expected - 1.0).abs());
        }
    }
    println!("{tolerance:e}: {errors:?} {:?}", motion.counts());
    (errors, motion.counts().evaluations)
}

#[test]
fn ten_digits_in_1600_evaluations() {
    let (errors, evaluations) = errors::<Dop853>(1e-11);
    assert!(errors[0] < 1e-10 && evaluations <= 1600, "{errors:?} {evaluations}");
}

#[test]
fn twelve_digits_at_the_tightest_tolerance() {
    let (errors, _) = errors::<Dop853>(1e-14);
    assert!(errors[0] < 1e-12 && errors[1] < 1e-10, "{errors:?}");
}

/// A tenth of the tolerance gains at least part of a digit, by either method.
#[test]
fn digits_follow_the_tolerance() {
    for (tolerance, bound) in [(1e-6, 1e-5), (1e-8, 5e-7), (1e-10, 5e-9), (1e-12, 5e-11)] {
        let (high, _) = errors::<Dop853>(tolerance);
        let (low, _) = errors::<Dopri5>(tolerance);
        assert!(high[0] < bound && low[0] < bound, "{tolerance:e}: {high:?} {low:?}");
    }
}
