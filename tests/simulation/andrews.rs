//! Andrews' squeezing mechanism: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem Solvers", release 2.4
//! (2008), problem "andrews"; the constants are those of the scene.

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::linkage;
use linkage::simulation::{State, simulate};

include!("../mechanisms/andrews_scene.rs");

const START: SqueezerCoordinates = SqueezerCoordinates {
    beta: -0.061_713_890_014_276_45,
    theta: 0.0,
    gamma: 0.455_279_819_163_070_4,
    phi: 0.222_668_390_165_885_87,
    delta: 0.487_364_979_543_842_55,
    omega: -0.222_668_390_165_885_87,
    epsilon: 1.230_547_444_549_821_2,
};

/// The position and its rates at t = 0.03, by extrapolation (Gragg, Bulirsch and Stoer) of order 24 with 42 digits; the
/// test set's own figures, of about 10 digits, agree.
const END: [(f64, f64); 7] = [
    (15.810_771_195_153_708, 1_139.920_302_259_106),
    (-15.756_371_058_411_84, -1_424.379_295_177_54),
    (0.040_822_240_119_645_85, 11.032_911_910_618_594),
    (-0.534_730_116_342_079_6, 19.293_374_105_032_04),
    (0.524_409_965_879_954_1, 0.573_569_914_829_502_4),
    (0.534_730_116_342_079_6, -19.293_374_105_032_04),
    (1.048_080_741_041_937_8, 0.323_179_149_249_130_9),
];

/// The largest relative errors of positions and rates, and the evaluations they took.
fn errors<M: Method>(tolerance: f64) -> ([f64; 2], usize) {
    let scene = Squeezing::default();
    let mut motion = simulate(&scene, (0.0, START, 0.0), 0.03, tolerance).unwrap().method::<M>().unwrap();
    motion.finish(|_, _| true).unwrap();
    let State { q, rate, t, .. } = *motion.state();
    assert_eq!(t, 0.03);
    let all = |q: SqueezerCoordinates<f64>| [q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon];
    let mut errors = [0.0_f64; 2];
    for ((found, rate), (expected, expected_rate)) in all(q).into_iter().zip(all(rate)).zip(END) {
        errors[0] = errors[0].max((found / expected - 1.0).abs());
        errors[1] = errors[1].max((rate / expected_rate - 1.0).abs());
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

/// A tenth of the tolerance is at least some of a digit, by either method.
#[test]
fn digits_follow_the_tolerance() {
    for (tolerance, bound) in [(1e-6, 1e-5), (1e-8, 5e-7), (1e-10, 5e-9), (1e-12, 5e-11)] {
        let (high, _) = errors::<Dop853>(tolerance);
        let (low, _) = errors::<Dopri5>(tolerance);
        assert!(high[0] < bound && low[0] < bound, "{tolerance:e}: {high:?} {low:?}");
    }
}
