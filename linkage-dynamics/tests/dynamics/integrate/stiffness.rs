//! Stiff equations are told from vibrations, in any units.

use linkage_dynamics::MotionError;
use linkage_dynamics::integrate::{Counts, Tolerance, dop853, dopri5};
use linkage_runtime::nalgebra::vector;

use super::systems::{HORIZONTAL, pendulum};
use super::{Rate, State, tolerance};

/// Integrates by both methods; returns the costs, or the first error of each.
fn by_both<const N: usize>(
    rate: impl Fn(f64, &State<N>) -> Rate<N> + Copy,
    (y, end): (State<N>, f64),
    (relative, scale): (f64, [f64; N]),
    every: usize,
) -> [Result<Counts, MotionError>; 2] {
    let tolerance = || Tolerance::new(relative, scale).unwrap();
    let mut one = dop853(rate, (0.0, y), end, tolerance()).unwrap().stiffness_test(every).most_steps(1_000_000);
    let mut other = dopri5(rate, (0.0, y), end, tolerance()).unwrap().stiffness_test(every).most_steps(1_000_000);
    [one.finish(|_, _| true).map(|()| one.counts()), other.finish(|_, _| true).map(|()| other.counts())]
}

/// Both methods find that stability limits their steps, within `most` of the interval.
#[track_caller]
fn is_stiff<const N: usize>(
    rate: impl Fn(f64, &State<N>) -> Rate<N> + Copy,
    (y, end): (State<N>, f64),
    scale: [f64; N],
) {
    for relative in [1e-4, 1e-6] {
        for result in by_both(rate, (y, end), (relative, scale), 1000) {
            let Err(MotionError::Stiff { t, product }) = result else { panic!("{relative}: {result:?}") };
            assert!(t < 0.5 * end && product > 3.25 && product < 10.0, "{relative}: {t} {product}");
        }
    }
}

/// x'' = -2 zeta w x' - w^2 (x - sin t).
fn oscillator(zeta: f64, w: f64) -> impl Fn(f64, &State<2>) -> Rate<2> + Copy {
    move |t, y| Ok(vector![y[1], -2.0 * zeta * w * y[1] - w * w * (y[0] - t.sin())])
}

#[test]
fn stiff_equations_are_told() {
    is_stiff(|t, y| Ok(vector![-1e4 * (y[0] - t.cos())]), (vector![0.0], 10.0), [1.0]);
    // Van der Pol's equation with mu = 1000.
    let relaxation = |_, y: &State<2>| Ok(vector![y[1], 1e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]]);
    is_stiff(relaxation, (vector![2.0, 0.0], 1000.0), [1.0; 2]);
    // c = 1e5, k = 1e4, in metres and in micrometres.
    let damped = |t: f64, y: &State<2>| Ok(vector![y[1], -1e5 * y[1] - 1e4 * (y[0] - t.sin())]);
    is_stiff(damped, (vector![0.0, 1.0], 10.0), [1.0; 2]);
    is_stiff(move |t, y| Ok(damped(t, &(y * 1e-6))? * 1e6), (vector![0.0, 1e6], 10.0), [1e6; 2]);
    // An oscillation that is half as much damped as the critical one decays within a step.
    is_stiff(oscillator(0.5, 1e4), (vector![0.1, 1.0], 10.0), [1.0, 1e3]);
    // Robertson's reactions.
    let reactions = |_, y: &State<3>| {
        let [a, b, c] = [0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]];
        Ok(vector![b - a, a - b - c, c])
    };
    is_stiff(reactions, (vector![1.0, 0.0, 0.0], 1e3), [1.0, 1e-4, 1.0]);
    // Conduction of heat in eight equal parts of a rod: several large eigenvalues.
    let heat = |t: f64, y: &State<8>| {
        let before = |i: usize| if i == 0 { t.sin() } else { y[i - 1] };
        let after = |i: usize| if i == 7 { 0.0 } else { y[i + 1] };
        Ok(State::<8>::from_fn(|i, _| 1e4 * (before(i) - 2.0 * y[i] + after(i))))
    };
    is_stiff(heat, (State::<8>::zeros(), 10.0), [1.0; 8]);
}

/// A vibration is in the solution, however large |J d| / |d| is in the units of the state: its step is that of the
/// accuracy, and no method can skip it.
#[test]
fn vibrations_are_not_stiff() {
    let vibration = |_, y: &State<2>| Ok(vector![y[1], -1e6 * y[0]]);
    for (start, scale) in [(0.1, [1.0, 1.0]), (0.1, [1.0, 1e3]), (0.1, [1e3, 1.0]), (1e-7, [1.0, 1e3])] {
        for relative in [1e-4, 1e-8] {
            for result in by_both(vibration, (vector![start, 0.0], 4.0), (relative, scale), 1) {
                assert!(result.is_ok(), "{start} {scale:?} {relative}: {result:?}");
            }
        }
    }
    // A fast spring on a slow one: no motion of it, but the step is limited by it.
    let chain = |_, y: &State<4>| Ok(vector![y[2], y[3], -y[0] - 0.01 * (y[0] - y[1]), -1e6 * (y[1] - y[0])]);
    for result in by_both(chain, (vector![1.0, 1.0, 0.0, 0.0], 4.0), (1e-6, [1.0; 4]), 1) {
        assert!(result.is_ok(), "{result:?}");
    }
    // Slightly damped.
    for result in by_both(oscillator(0.02, 1e3), (vector![0.1, 1.0], 4.0), (1e-6, [1.0, 1e3]), 1) {
        assert!(result.is_ok(), "{result:?}");
    }
    let mut motion = dopri5(pendulum, (0.0, HORIZONTAL), 200.0, tolerance(1e-10)).unwrap().stiffness_test(1);
    motion.finish(|_, _| true).unwrap();
    assert!(motion.counts().accepted > 5000);
}

/// A test changes no step, and costs an evaluation at most, none where the step is clearly stable.
#[test]
fn the_test_changes_no_step() {
    let run = |end: f64, relative: f64, every: usize| {
        let mut motion = dop853(pendulum, (0.0, HORIZONTAL), end, tolerance(relative)).unwrap().stiffness_test(every);
        motion.finish(|_, _| true).unwrap();
        (*motion.state(), motion.counts())
    };
    let ((tested, cost), (plain, least)) = (run(100.0, 1e-4, 1), run(100.0, 1e-4, 0));
    assert_eq!(tested, plain);
    assert!(cost.evaluations <= least.evaluations + least.accepted, "{cost:?} {least:?}");
    assert_eq!(run(100.0, 1e-12, 1), run(100.0, 1e-12, 0));
}

#[test]
fn the_test_can_be_switched_off() {
    let rate = |t: f64, y: &State<1>| Ok(vector![-1e4 * (y[0] - t.cos())]);
    let mut motion = dop853(rate, (0.0, vector![0.0]), 10.0, tolerance(1e-4)).unwrap().stiffness_test(0);
    motion.finish(|_, _| true).unwrap();
    assert!((motion.state()[0] - 10f64.cos()).abs() < 1e-3);
}
