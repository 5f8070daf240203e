//! Motions with friction by reactions, against closed forms and the balance of energy.

use super::curve::{Curve, Particle, Path};
use linkage_dynamics::contact::Change;
use linkage_dynamics::simulation::{Start, simulate};
use linkage_dynamics::{Mode, MotionError};
use linkage_runtime::Column;

fn at_rest(_: f64) -> f64 {
    0.0
}

/// A block on a slope: the normal force counts.
fn block(slope: f64, factors: [f64; 1], push: fn(f64) -> f64) -> Particle<1> {
    let normal = Some([-slope.sin(), slope.cos()]);
    Particle { path: Path(Curve::Line(slope)), mass: 2.0, inertia: 0.0, gravity: 9.81, push, factors, normal }
}

/// A pendulum in a journal bearing: a particle of mass 1.5 at the distance 0.8, and the whole reaction.
fn pendulum<const C: usize>(factors: [f64; C]) -> Particle<C> {
    let path = Path(Curve::Ellipse(0.8, 0.8));
    Particle { path, mass: 1.5, inertia: 0.0, gravity: 9.81, push: at_rest, factors, normal: None }
}

/// It slides up, stops, and stays or slides back.
#[test]
fn a_block_on_a_slope_moves_by_the_closed_form() {
    for (slope, friction) in [(0.4_f64, 0.3), (0.4, 0.6), (-0.2, 0.1), (0.0, 0.25)] {
        let scene = block(slope, [friction], at_rest);
        let up = -9.81 * (slope.sin() + friction * slope.cos());
        let stop = -2.0 / up;
        let reach = -0.5 * 4.0 / up;
        let pull = slope.sin().abs() - friction * slope.cos();
        let mut motion = simulate(&scene, Start { t: 0.0, q: [0.0; 3], input_rates: [2.0] }, 2.0, 1e-11).unwrap();
        for state in motion.at((0..=40).map(|k| f64::from(k) * 0.05)) {
            let state = state.unwrap();
            let (t, v) = (state.t, state.q[2]);
            let expected = if t < stop {
                2.0 * t + 0.5 * up * t * t
            } else {
                reach - 0.5 * 9.81 * pull.max(0.0) * slope.signum() * (t - stop) * (t - stop)
            };
            assert!((v - expected).abs() < 1e-10, "{slope} {friction} {t}: {v} {expected}");
            let stays = t > stop && pull <= 0.0;
            assert_eq!(state.contacts[0].mode == Mode::Stick, stays, "{slope} {friction} {t}");
        }
    }
}

/// A block held by friction under a growing push begins to slip where the push exceeds it.
#[test]
fn a_held_block_is_released_at_its_limit() {
    let scene = block(0.2, [0.5], |t| 10.0 * t);
    let begins = 2.0 * 9.81 * (0.2_f64.sin() + 0.5 * 0.2_f64.cos()) / 10.0;
    let mut motion = simulate(&scene, Start { t: 0.0, q: [0.0; 3], input_rates: [0.0] }, 2.0, 1e-9).unwrap();
    let mut slips = vec![];
    while let Some(state) = motion.advance().unwrap() {
        slips.extend(state.changes().map(|(_, change)| (state.t, change)));
    }
    let [(t, Change::Slips)] = slips[..] else { panic!("{slips:?}") };
    assert!((t - begins).abs() < 1e-9, "{t} {begins}");
    // s'' = 5 (t - begins): s grows with its cube.
    let expected = 5.0 / 6.0 * (2.0 - begins).powi(3);
    assert!((motion.state().q[2] - expected).abs() < 1e-8, "{} {expected}", motion.state().q[2]);
}

/// phi'' of the pendulum: with R = |R_n| / sqrt(1 - (c / l)^2) the tangential equation is explicit.
fn swing(factor: f64, [angle, rate]: [f64; 2]) -> f64 {
    let (length, gravity): (f64, f64) = (0.8, 9.81);
    let normal = length * rate * rate + gravity * angle.cos();
    let reaction = normal.abs() / (1.0 - (factor / length).powi(2)).sqrt();
    -gravity / length * angle.sin() - rate.signum() * factor * reaction / (length * length)
}

/// A step of the classical method of order 4.
fn step(factor: f64, [angle, rate]: [f64; 2], h: f64) -> [f64; 2] {
    let slope = |y: [f64; 2]| [y[1], swing(factor, y)];
    let moved = |k: [f64; 2], h: f64| [angle + h * k[0], rate + h * k[1]];
    let a = slope([angle, rate]);
    let b = slope(moved(a, h / 2.0));
    let c = slope(moved(b, h / 2.0));
    let d = slope(moved(c, h));
    moved([0, 1].map(|k| (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) / 6.0), h)
}

#[test]
fn a_journal_bearing_brakes_by_the_explicit_law() {
    let factor = 0.05;
    let scene = pendulum([factor]);
    let start = [scene.path.0.at(1.2)[0][0], scene.path.0.at(1.2)[0][1], 1.2];
    let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: [-0.5] }, 0.7, 1e-12).unwrap();
    let mut y = [1.2, -0.5];
    for k in 1..=7 {
        for _ in 0..1000 {
            y = step(factor, y, 1e-4);
        }
        let state = motion.at([f64::from(k) / 10.0]).next().unwrap().unwrap();
        assert!((state.q[2] - y[0]).abs() < 1e-10 && (state.rates[2] - y[1]).abs() < 1e-10, "{k}: {state:?} {y:?}");
    }
}

/// It swings until it stays within the friction circle: |sin phi| <= c / l.
#[test]
fn a_pendulum_in_a_journal_bearing_comes_to_rest_within_the_friction_circle() {
    for (factor, angle) in [(0.02, 1.0), (0.1, 2.0), (0.3, 1.5)] {
        let scene = pendulum([factor]);
        let [point, ..] = scene.path.0.at(angle);
        let mut motion =
            simulate(&scene, Start { t: 0.0, q: [point[0], point[1], angle], input_rates: [0.0] }, 40.0, 1e-9).unwrap();
        let mut reversals = 0;
        while let Some(state) = motion.advance().unwrap() {
            reversals += state.changes().count();
        }
        let state = *motion.state();
        assert_eq!((state.contacts[0].mode, state.rates[2]), (Mode::Stick, 0.0), "{factor}: {state:?}");
        assert!(state.q[2].sin().abs() <= factor / 0.8, "{factor}: {state:?}");
        assert!(reversals > 0, "{factor}");
        assert!(motion.loads().unwrap().are_unique);
    }
    // At rest the limit is the friction circle, to a part in 1e12.
    for (share, mode) in [(1.0 + 1e-12, Mode::SlipBackward), (1.0 - 1e-12, Mode::Stick)] {
        let scene = pendulum([0.1]);
        let angle = (0.1_f64 / 0.8).asin() * share;
        let [point, ..] = scene.path.0.at(angle);
        let motion =
            simulate(&scene, Start { t: 0.0, q: [point[0], point[1], angle], input_rates: [0.0] }, 1.0, 1e-9).unwrap();
        assert_eq!(motion.state().contacts[0].mode, mode, "{share}");
    }
}

/// At each turning point all frictions of a joint stand at once, as in a linkage with one input.
#[test]
fn several_frictions_of_one_motion_come_to_rest() {
    let scene = pendulum([0.03, 0.05, 0.02, 0.01]);
    let [point, ..] = scene.path.0.at(1.4);
    let mut motion =
        simulate(&scene, Start { t: 0.0, q: [point[0], point[1], 1.4], input_rates: [0.0] }, 20.0, 1e-9).unwrap();
    let mut reversals = 0;
    while let Some(state) = motion.advance().unwrap() {
        reversals += usize::from(state.changes().next().is_some());
    }
    let state = motion.state();
    assert!(reversals > 2 && state.contacts.iter().all(|touch| touch.mode == Mode::Stick), "{reversals} {state:?}");
    assert!(state.q[2].sin().abs() <= 0.11 / 0.8);
    assert!(!motion.loads().unwrap().are_unique);
}

/// The abscissae and weights of Gauss's rule of order 10 on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// The energy that is lost is the work of friction, to 1e-9 of what flows.
#[test]
fn the_energy_lost_is_the_work_of_friction() {
    let scene = pendulum([0.03, 0.05]);
    let [point, ..] = scene.path.0.at(1.4);
    let mut motion =
        simulate(&scene, Start { t: 0.0, q: [point[0], point[1], 1.4], input_rates: [0.0] }, 3.0, 1e-12).unwrap();
    let (mut work, mut from) = (0.0, 0.0);
    let start = scene.energy(1.4, 0.0);
    let mut events = 0;
    while let Some(state) = motion.advance().unwrap() {
        let length = state.t - from;
        events += usize::from(state.changes().next().is_some());
        for (place, weight) in GAUSS {
            let inside = motion.at([from + length * place]).next().unwrap().unwrap();
            let modes: Column<Mode, _> = inside.contacts.map(|touch| touch.mode);
            let [first, second] = scene.frictions(inside.t, inside.q[2], inside.rates[2], modes).unwrap();
            work += weight * length * (first + second) * inside.rates[2];
        }
        from = state.t;
    }
    let state = motion.state();
    let lost = scene.energy(state.q[2], state.rates[2]) - start;
    assert!(events > 2 && work < -1.0, "{events} {work}");
    assert!((lost - work).abs() <= 1e-9 * work.abs(), "{lost} {work}");
}

/// Two frictions of one joint hold together: redundant, so that only their sum is determined.
#[test]
fn redundant_frictions_hold_up_to_the_sum_of_their_limits() {
    let push: fn(f64) -> f64 = |t| 2.0 * t;
    let scene = Particle { push, ..pendulum([0.1, 0.2]) };
    let mut motion = simulate(&scene, Start { t: 0.0, q: [0.0, -0.8, 0.0], input_rates: [0.0] }, 4.0, 1e-9).unwrap();
    assert!(!motion.loads().unwrap().are_unique);
    let mut slips = vec![];
    while let Some(state) = motion.advance().unwrap() {
        if state.changes().next().is_some() {
            slips.push(state.t);
            break;
        }
        let loads = motion.loads().unwrap();
        assert!((loads.contacts.sum() + 2.0 * state.t).abs() < 1e-12);
    }
    // |R| = m g at rest.
    let expected = (0.1 + 0.2) * 1.5 * 9.81 / 2.0;
    assert!(slips.len() == 1 && (slips[0] - expected).abs() < 1e-9, "{slips:?} {expected}");
    assert!(motion.loads().unwrap().are_unique);
}

/// On an ellipse the arm of the reaction shrinks until the friction circle contains it: no acceleration is possible
/// then, and the error has the time.
#[test]
fn a_motion_that_ceases_to_exist_is_an_error_with_its_time() {
    let path = Path(Curve::Ellipse(1.0, 0.3));
    let scene = Particle { path, mass: 1.0, inertia: 0.0, gravity: 0.0, push: at_rest, factors: [0.5], normal: None };
    let mut motion = simulate(&scene, Start { t: 0.0, q: [0.0, -0.3, 0.0], input_rates: [3.0] }, 5.0, 1e-9).unwrap();
    let error = loop {
        match motion.advance() {
            Ok(Some(_)) => {}
            Ok(None) => panic!("it goes on to v = {}", motion.state().q[2]),
            Err(error) => break error,
        }
    };
    let MotionError::NoMotion { scene: "Particle", contact: "friction on v", t: Some(t) } = error else {
        panic!("{error}")
    };
    // c^2 = a^2 cos^2 + b^2 sin^2.
    let limit = ((0.25_f64 - 0.09) / 0.91).sqrt().acos();
    assert!((motion.state().q[2] - limit).abs() < 1e-2, "{} {limit}", motion.state().q[2]);
    assert!((t - motion.state().t).abs() < 1e-2, "{t} {}", motion.state().t);
}
