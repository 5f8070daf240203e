//! The car axis: F. Mazzia and C. Magherini, "Test Set for Initial Value Problem Solvers", release 2.4 (2008), problem "car
//! axis", of index 3 with constraints; the constants are those of the scene.

use linkage::integrate::{Dop853, Dopri5, Method};
use linkage::simulation::{Start, simulate};

use linkage_examples::car_axis::elsewhere::{DOP853, FAILURES};
use linkage_examples::car_axis::ride::Ride;
use linkage_examples::car_axis::runs::{ends, run};
use linkage_gallery::car_axis::*;
use linkage_gallery::car_axis_motion::{
    END, END_TIME, END_VELOCITIES, PUBLISHED_END, PUBLISHED_VELOCITIES, START, START_RATES,
};

fn largest(found: [f64; 4], expected: [f64; 4]) -> f64 {
    found.into_iter().zip(expected).fold(0.0, |worst, (found, expected)| worst.max((found / expected - 1.0).abs()))
}

/// At the start the multipliers are zero: both ends fall freely. The test set prints the positions, the velocities and these
/// accelerations.
#[test]
fn starts_as_published() {
    let scene = Riding::default();
    let axis = &scene.mechanism;
    let accelerations = scene.rates(0.0, &START, START_RATES).unwrap().input_accelerations;
    let motion =
        axis.full_kinematics(CarAxisInputs::from(&START), CarAxisBranch::new(), START_RATES, accelerations).unwrap();
    let [left, right] = [motion.points.left, motion.points.right];
    assert_eq!([left.position, right.position].map(|at| [at.x, at.y]), [[0.0, 0.5], [1.0, 0.5]]);
    assert_eq!([left.velocity, right.velocity].map(|v| [v.x, v.y]), [[-0.5, 0.0], [-0.5, 0.0]]);
    for acceleration in [left.acceleration, right.acceleration] {
        assert!(acceleration.x.abs() < 1e-15 * scene.g, "{acceleration}");
        assert!((acceleration.y / -scene.g - 1.0).abs() < 1e-15, "{acceleration}");
    }
}

/// The published positions to 1e-10 and velocities to 1e-8; against 40 digits it is nearer than they are.
#[test]
fn ends_as_published() {
    let scene = Riding::default();
    let start = Start { t: 0.0, q: START, input_rates: START_RATES };
    let mut motion = simulate(&scene, start, END_TIME, 1e-13).unwrap();
    motion.finish(|_, _| true).unwrap();
    let state = motion.state();
    assert_eq!(state.t, END_TIME);
    let [at, moving] = ends(state, &scene).unwrap();
    assert!(largest(at, PUBLISHED_END) < 1e-10 && largest(moving, PUBLISHED_VELOCITIES) < 1e-8);
    let exact = [largest(at, END), largest(moving, END_VELOCITIES)];
    let published = [largest(PUBLISHED_END, END), largest(PUBLISHED_VELOCITIES, END_VELOCITIES)];
    println!("{exact:?} {published:?} {:?}", motion.counts());
    assert!(exact[0] < 2.5e-13 && exact[1] < 5e-11, "{exact:?}");
    assert!(published[0] < 6.6e-13 && published[1] < 5.8e-10, "{published:?}");

    // The bumps turn the axis against the guide of the left end, whose force is the test set's first multiplier times the
    // vector of the axis (GAMD in quadruple precision), and against the right spring at the wheel.
    let multiplier = -0.004_736_886_590_848_933;
    let Riding { k, l0, .. } = scene;
    let l = scene.mechanism.l;
    let points = scene.mechanism.points(&scene.mechanism.pose_at(&state.q)).unwrap();
    let spring = points.right - points.wheel;
    let pull = spring * (k * (l0 / spring.norm() - 1.0));
    let expected = points.wheel.coords.perp(&pull) - state.q.s * l * multiplier;
    let found = scene.drive_forces(state.t, &state.q, CarAxisInputs::from(&state.rates)).unwrap().beta;
    assert!((found / expected - 1.0).abs() < 1e-11, "{found} {expected}");
}

/// A tenth of the tolerance gains at least part of a digit, by either method.
#[test]
fn digits_follow_the_tolerance() {
    for (tolerance, bound) in [(1e-6, 1e-5), (1e-8, 1e-7), (1e-10, 1e-9), (1e-12, 1e-11)] {
        let [high, low] = [errors::<Dop853>(tolerance), errors::<Dopri5>(tolerance)];
        assert!(high < bound && low < bound, "{tolerance:e}: {high:e} {low:e}");
    }
}

fn errors<M: Method>(tolerance: f64) -> f64 {
    let run = run::<M>(tolerance).unwrap();
    println!("{tolerance:e}: {:?} {} {}", run.errors, run.steps, run.evaluations);
    run.errors[0]
}

/// No more steps than DOP853 of scipy on the equations reduced by hand, to a tenth.
#[test]
fn as_few_steps_as_by_hand() {
    for by_hand in DOP853 {
        let run = run::<Dop853>(by_hand.tolerance).unwrap();
        println!("{} {} {} {}", run.steps, by_hand.steps, run.evaluations, by_hand.evaluations);
        assert!(10 * run.steps < 11 * by_hand.steps && 10 * run.evaluations < 11 * by_hand.evaluations);
    }
}

/// The energy that the chassis gains is the work of the bumps.
#[test]
fn the_bumps_do_the_work() {
    let ride = Ride::new(Riding::default()).unwrap();
    let ([least, most], [gained, work]) = (ride.energies, ride.balance);
    println!("{gained} {work} {least} {most}");
    assert!((gained - work).abs() < 1e-11 * (most - least), "{gained} {work}");
}

#[test]
fn fourteen_pairs_fail_elsewhere() {
    assert_eq!(FAILURES.iter().map(|formulation| formulation.outcomes.len()).sum::<usize>(), 14);
}
