//! Published motions, and reproducibility.

use linkage_dynamics::integrate::{Counts, FixedStep, Integration, Method, System, Tolerance, dop853, dopri5};
use linkage_runtime::D;
use linkage_runtime::nalgebra::vector;
use num_dual::Dual64;

use super::systems::{BOB, HORIZONTAL, ORBIT, ORBIT_PERIOD, arenstorf, pendulum};
use super::{State, tolerance};

#[test]
fn the_bob_of_the_pendulum_is_where_the_exact_law_has_it() {
    for (relative, until, bound) in [(1e-7, 10.0, 5e-6), (1e-10, 100.0, 1e-7), (1e-13, 2000.0, 1e-8)] {
        let mut motion = dop853(pendulum, (0.0, HORIZONTAL), 2000.0, tolerance(relative)).unwrap();
        let rows = BOB.into_iter().filter(|&(t, _)| t <= until);
        let states = motion.at(rows.clone().map(|(t, _)| t)).collect::<Result<Vec<_>, _>>().unwrap();
        assert_eq!(states.len(), rows.clone().count());
        for ((at, y), (t, [x, z])) in states.into_iter().zip(rows) {
            assert_eq!(at, t);
            let error = (y[0].sin() - x).abs().max((-y[0].cos() - z).abs());
            println!("{relative:e} {t:6}: {error:.1e}");
            assert!(error < bound, "{relative:e} at {t}: {error:e}");
        }
    }
}

fn cost<S: System<Scalar = f64, N = D<N>>, M: Method, const N: usize>(
    mut motion: Integration<S, M>,
) -> (Counts, State<N>) {
    motion.finish(|_, _| true).unwrap();
    (motion.counts(), (*motion.state()).into())
}

/// The Fortran codes DOP853 and DOPRI5 of Hairer and Wanner on Arenstorf's orbit, with first step 1e-4 and relative and
/// absolute tolerance the same, run through scipy 1.13: tolerance, evaluations, accepted steps, and the distance of the
/// end from the start.
const DOP853: [(f64, usize, usize, f64); 6] = [
    (1e-3, 622, 38, 1.198_966_977_5),
    (1e-5, 857, 53, 0.121_118_771_3),
    (1e-7, 1351, 85, 1.556_288_701e-3),
    (1e-9, 2240, 138, 9.377_178_6e-6),
    (1e-11, 3453, 229, 9.536e-8),
    (1e-13, 5033, 390, 8.9e-10),
];
const DOPRI5: [(f64, usize, usize, f64); 6] = [
    (1e-3, 307, 42, 1.712_685_440_1),
    (1e-5, 709, 94, 0.446_829_518_3),
    (1e-7, 1429, 217, 1.459_758_284e-3),
    (1e-9, 3205, 531, 1.878_989_1e-5),
    (1e-11, 8005, 1333, 2.733e-7),
    (1e-13, 20113, 3350, 2.1e-9),
];

#[test]
fn costs_and_errors_are_those_of_the_published_codes() {
    let check = |(relative, evaluations, accepted, miss): (f64, usize, usize, f64), (ours, end): (Counts, State<4>)| {
        assert_eq!((ours.evaluations, ours.accepted), (evaluations, accepted), "{relative:e}");
        let missed = (end - ORBIT).amax();
        // Only rounding errors differ, which the orbit magnifies by more than 1e5.
        assert!((missed - miss).abs() < 1e-5 * miss + 1e-9, "{relative:e}: {missed:e} and {miss:e}");
    };
    for row in DOP853 {
        let motion = dop853(arenstorf, (0.0, ORBIT), ORBIT_PERIOD, tolerance(row.0)).unwrap();
        check(row, cost(motion.first_step(1e-4).unwrap()));
    }
    for row in DOPRI5 {
        let motion = dopri5(arenstorf, (0.0, ORBIT), ORBIT_PERIOD, tolerance(row.0)).unwrap();
        check(row, cost(motion.first_step(1e-4).unwrap()));
    }
}

#[test]
fn equal_runs_are_equal_to_the_bit_however_they_are_looked_at() {
    let new = || dop853(arenstorf, (0.0, ORBIT), ORBIT_PERIOD, tolerance(1e-9)).unwrap();
    let steps: Vec<_> = new().map(Result::unwrap).collect();
    assert_eq!(steps, new().map(Result::unwrap).collect::<Vec<_>>());
    let mut asked = new();
    let states = asked.at((0..=100).map(|i| ORBIT_PERIOD * f64::from(i) / 100.0)).count();
    assert_eq!((states, asked.state()), (101, &steps[steps.len() - 1].state));
    // Dense output takes three evaluations in each step with an output.
    assert!(asked.counts().evaluations <= cost(new()).0.evaluations + 3 * 99);
    let mut paused = new();
    let mut done = 0.0;
    while !paused.is_over() {
        paused
            .finish(|_, part| {
                assert!(part > done);
                done = part;
                false
            })
            .unwrap();
    }
    assert_eq!((done, paused.state()), (1.0, asked.state()));
}

#[test]
fn units_change_nothing() {
    // Lengths 2^20 times and times 2^-9 times as large: all numbers differ only in their exponents.
    let (length, time) = (2f64.powi(20), 2f64.powi(-9));
    let free = |length: f64, time: f64| {
        let mu = length * length * length / (time * time);
        let rate = move |_: f64, y: &State<4>| {
            let square = y[0] * y[0] + y[1] * y[1];
            let k = mu / (square * square.sqrt());
            Ok(vector![y[2], y[3], -k * y[0], -k * y[1]])
        };
        let sizes = vector![length, length, length / time, length / time];
        let start = vector![length, 0.0, 0.0, 1.25 * length / time];
        let motion = dop853(rate, (0.0, start), 20.0 * time, Tolerance::new(1e-10, sizes).unwrap()).unwrap();
        let steps: Vec<_> = motion.map(Result::unwrap).collect();
        steps.into_iter().map(|step| (step.t / time, step.state.component_div(&sizes.into()))).collect::<Vec<_>>()
    };
    assert_eq!(free(1.0, 1.0), free(length, time));
    assert!(free(1.0, 1.0).len() > 20);
    // From rest at zero, where the first step has no estimate, and with a slope that is negligible relative to the
    // scale.
    for speed in [0.0, 1e-7] {
        let pulled = |length: f64, time: f64| {
            let rate = move |_: f64, y: &State<2>| Ok(vector![y[1], (1e-7 * length - y[0]) / (time * time)]);
            let sizes = vector![length, length / time];
            let start = vector![0.0, speed * length / time];
            let motion = dop853(rate, (0.0, start), 20.0 * time, Tolerance::new(1e-3, sizes).unwrap()).unwrap();
            motion
                .map(Result::unwrap)
                .map(|step| (step.t / time, step.state.component_div(&sizes.into())))
                .collect::<Vec<_>>()
        };
        assert_eq!(pulled(1.0, 1.0), pulled(length, time));
    }
}

/// A state of zero tells nothing of the time in which it moves: that follows from its scale, not from the length of a
/// run that is much longer.
#[test]
fn a_first_step_from_zero_is_the_same_in_every_long_run() {
    for moves_in in [1e-3, 1.0, 1e3] {
        let begun = |runs: f64| {
            let rate = move |_: f64, y: &State<2>| Ok(vector![y[1] / moves_in, (1.0 - y[0]) / moves_in]);
            let motion = dop853(rate, (0.0, vector![0.0, 0.0]), runs * moves_in, tolerance(1e-9)).unwrap();
            motion.take(3).map(Result::unwrap).collect::<Vec<_>>()
        };
        // Longer than the ten thousand times from which the scale decides.
        let [one, other] = [begun(1e6), begun(1e9)];
        assert_eq!(one, other);
        assert!(one[0].t <= moves_in, "{}", one[0].t);
    }
}

#[test]
fn backwards_leads_back() {
    for end in [7.0, -7.0] {
        let there = cost(dop853(pendulum, (0.0, HORIZONTAL), end, tolerance(1e-13)).unwrap()).1;
        assert!((there - HORIZONTAL).amax() > 0.1);
        let back = cost(dop853(pendulum, (end, there), 0.0, tolerance(1e-13)).unwrap()).1;
        assert!((back - HORIZONTAL).amax() < 1e-11, "{back}");
    }
    // Backwards in time the outputs descend.
    let mut motion = dopri5(pendulum, (0.0, HORIZONTAL), -2.0, tolerance(1e-10)).unwrap();
    let states: Vec<_> = motion.at([-0.5, -1.0, -2.0]).map(Result::unwrap).collect();
    for ((t, y), (time, [x, _])) in states.into_iter().zip(BOB) {
        assert_eq!(t, -time);
        assert!((y[0].sin() - x).abs() < 1e-8);
    }
}

#[test]
fn dual_numbers_carry_derivatives_through() {
    // y'' = -w^2 y: dy/dw = -t sin(w t).
    let w = Dual64::new(1.5, 1.0);
    let rate = move |_: Dual64, y: &linkage_runtime::nalgebra::SVector<Dual64, 2>| Ok(vector![y[1], -w * w * y[0]]);
    let real = |_: f64, y: &State<2>| Ok(vector![y[1], -1.5 * 1.5 * y[0]]);
    let one = [Dual64::from(1.0); 2];
    let start = (Dual64::from(0.0), vector![Dual64::from(1.0), Dual64::from(0.0)]);
    let mut motion = dop853(rate, start, Dual64::from(10.0), Tolerance::new(1e-12, one).unwrap()).unwrap();
    motion.finish(|_, _| true).unwrap();
    let y = motion.state()[0];
    assert!((y.re - 15f64.cos()).abs() < 1e-10 && (y.eps + 10.0 * 15f64.sin()).abs() < 1e-8, "{y}");
    let plain = cost(dop853(real, (0.0, vector![1.0, 0.0]), 10.0, tolerance(1e-12)).unwrap());
    assert_eq!((plain.0, plain.1[0]), (motion.counts(), y.re));
}

#[test]
fn single_precision_is_integrated_as_well() {
    let rate = |_: f32, y: &linkage_runtime::nalgebra::SVector<f32, 2>| Ok(vector![y[1], -y[0]]);
    let mut motion = dopri5(rate, (0.0, vector![1.0, 0.0]), 6.0, Tolerance::new(1e-5, [1.0; 2]).unwrap()).unwrap();
    let (_, y) = motion.at([3.0, 6.0]).last().unwrap().unwrap();
    assert!((y[0] - 6f32.cos()).abs() < 1e-4, "{y:?}");
}

#[test]
fn fixed_steps_keep_an_undamped_oscillation() {
    let mut motion = FixedStep::new(pendulum, (0.0, HORIZONTAL), 1e-3).unwrap();
    for _ in 0..10_000 {
        motion.step().unwrap();
    }
    assert_eq!(motion.t(), 10.0);
    let y = motion.state();
    assert!((y[0].sin() - BOB[4].1[0]).abs() < 1e-8);
    // At the stability limit 2 sqrt(2): just below it an oscillation decays, just above it grows.
    let amplitude = |h: f64| {
        let rate = |_: f64, y: &State<2>| Ok(vector![y[1], -y[0]]);
        let mut motion = FixedStep::new(rate, (0.0, vector![1.0, 0.0]), h).unwrap();
        (0..1000).for_each(|_| motion.step().unwrap());
        motion.state().norm()
    };
    assert!(amplitude(2.82) < 0.1 && amplitude(2.84) > 10.0);
}
