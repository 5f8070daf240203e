//! A five-bar of two cranks: one sticks while the other slips, impacts, and the energy account.

use linkage::integrate::{Tolerance, dop853};
use linkage::nalgebra::vector;
use linkage::{Column, D, Mode, Scene, StateParts};

use super::machines::*;
use linkage_oracle::close;

use super::moving::{Moving, run};

/// One crank is held by its friction while the other slips: the motion with a clamped crank.
#[test]
fn one_crank_sticks_while_the_other_slips() {
    let scene = Braked::default();
    let start = scene.start(0.0, &pair(1.1, 1.4), &PairInputs { theta1: 0.0, theta4: 0.4 }).unwrap();
    let clamped = Clamped { place: 1.1, ..Clamped::default() };
    let end = run(&scene, start, 0.6);
    let q = Braked::parts(&start).q;
    let rate = |t: f64, y: &Column<f64, D<6>>| clamped.derivative(t, y);
    let tolerance = Tolerance::new(1e-13, [1.0; 6]).unwrap();
    // The other slips forward first, stops, and goes back.
    let (turn, after) = (end.events[0].0, end.events[0].3);
    assert_eq!((end.events.len(), after), (1, [Mode::Stick, Mode::SlipBackward].into()), "{:?}", end.events);
    let begin = clamped.start(0.0, &q, &PairInputs { theta1: 0.0, theta4: 0.4 }).unwrap();
    let mut there = dop853(rate, (0.0, begin), turn, tolerance).unwrap();
    there.finish(|_, _| true).unwrap();
    close("turn", there.state()[5], 0.0, 1e-12);
    let back = Clamped { sign: -1.0, ..clamped.clone() };
    let rate = |t: f64, y: &Column<f64, D<6>>| back.derivative(t, y);
    let mut back = dop853(rate, (turn, *there.state()), 0.6, tolerance).unwrap();
    back.finish(|_, _| true).unwrap();
    close("y", (end.y - *back.state()).largest(), 0.0, 1e-11);
    assert_eq!((end.y[2], end.y[4]), (1.1, 0.0));
}

/// An impact of one crank, free and with the other resting on its stop: Newton's law, impulses that only push, and the
/// energy loss.
#[test]
fn impacts_of_a_five_bar() {
    let q = Pair::default().solve(&pair(1.2, 0.5)).unwrap().coordinates;
    let scene = Stopped::default();
    let mass = scene.mass_matrix(&q).unwrap();
    let after = |scene: &Stopped, rates: [f64; 2]| {
        let inputs = PairInputs { theta1: rates[0], theta4: rates[1] };
        let start = scene.start(0.0, &q, &inputs).unwrap();
        let (moving, y) = Moving::start(scene, 0.0, &start).unwrap();
        (<[Mode; 3]>::from(moving.contacts.modes), vector![y[4], y[5]])
    };
    // If both leave, nothing happens. If one hits: v'+ = v'- - M^-1 S' (1 + e) s' / (S M^-1 S').
    assert_eq!(after(&scene, [-1.0, 2.0]), ([Mode::Open; 3], vector![-1.0, 2.0]));
    let inverse = mass.try_inverse().unwrap();
    let hit = vector![2.0, 3.0] - inverse.column(0) * (1.6 * 2.0 / inverse[(0, 0)]);
    assert!(hit[1] > 0.0);
    let (modes, rates) = after(&scene, [2.0, 3.0]);
    assert_eq!(modes, [Mode::Open; 3]);
    close("v'", (rates - hit).amax(), 0.0, 1e-14);
    // The other rests: on one side it leaves its stop, on the other it would be pushed through it.
    let alone = vector![2.0, 0.0] - inverse.column(0) * (3.2 / inverse[(0, 0)]);
    assert!(alone[1] > 0.1, "{alone}");
    let (modes, rates) = after(&scene, [2.0, 0.0]);
    close("v'", (rates - alone).amax(), 0.0, 1e-14);
    assert_eq!(modes, [Mode::Open; 3]);
    let below = Stopped { lower4: -9.0, upper4: 0.5, ..scene.clone() };
    let (modes, rates) = after(&below, [2.0, 0.0]);
    close("v'", (rates - vector![-1.2, 0.0]).amax(), 0.0, 1e-14);
    assert_eq!((modes[0], rates[1]), (Mode::Open, 0.0));
    // Both hit.
    let (_, rates) = after(&scene, [2.0, -1.0]);
    let both = vector![-1.2, 0.6];
    let impulse = mass * (both - vector![2.0, -1.0]);
    assert!(impulse[0] < 0.0 && impulse[1] > 0.0, "{impulse}");
    close("v'", (rates - both).amax(), 0.0, 1e-14);
}

/// Elastic stops keep the energy, also one that acts on an output.
#[test]
fn elastic_stops_keep_the_energy() {
    let q = Pair::default().solve(&pair(0.9, 0.9)).unwrap().coordinates;
    let opening = q.theta2 - q.theta3;
    let scene = Narrow { half: 0.05, middle: opening, e1: 1.0, ..Narrow::default() };
    let start = scene.start(0.0, &q, &PairInputs { theta1: 0.7, theta4: -0.9 }).unwrap();
    let energy = |y: &Column<f64, D<6>>| {
        let StateParts { q, input_rates: rates } = Narrow::parts(y);
        scene.energy(&q, rates).unwrap().kinetic
    };
    let end = run(&scene, start, 3.0);
    assert!(end.events.len() > 4, "{:?}", end.events);
    for (_, y, _, after) in &end.events {
        close("on a stop", (y[0] - y[1] - opening).abs(), 0.05, 1e-12);
        assert_eq!(*after, [Mode::Open]);
    }
    close("energy", energy(&end.y) / energy(&start), 1.0, 1e-11);
}

/// Frictions, stops and an oscillating force, for a long time: the energy is the work done less the work of friction.
#[test]
fn a_long_motion_keeps_its_accounts() {
    let scene =
        Shaken { brake1: 2.0, brake4: 1.5, upper1: 1.3, lower4: 0.7, e1: 1.0, torque: 6.0, ..Shaken::default() };
    let q = Pair::default().solve(&pair(1.0, 1.0)).unwrap().coordinates;
    let start = scene.start(0.0, &q, &PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    let (moving, y) = Moving::start(&scene, 0.0, &start).unwrap();
    let tolerance = Tolerance::new(1e-10, [1.0; 6]).unwrap();
    let mut motion = dop853(moving, (0.0, y), 30.0, tolerance).unwrap().largest_step(0.02).unwrap();
    let (mut work, mut last) = (0.0, 0.0);
    // By Gauss's rule of three points on each piece between events.
    while let Some(step) = motion.advance().unwrap() {
        let piece = motion.interpolant().unwrap();
        let half = 0.5 * (step.t - last);
        for (place, weight) in [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)] {
            let t = last + half * (1.0 + place);
            let StateParts { q, input_rates: rates } = Shaken::parts(&piece.at(t));
            let power = scene.power(t, &q, rates).unwrap();
            work += half * weight * (power.applied - power.dissipated);
        }
        last = step.t;
    }
    let moving = motion.system();
    let StateParts { q, input_rates: rates } = Shaken::parts(motion.state());
    let energy = scene.energy(&q, rates).unwrap();
    let seen = |mode: Mode| moving.history.iter().filter(|(_, _, after)| after.as_slice().contains(&mode)).count();
    let often = [Mode::Stick, Mode::SlipForward, Mode::SlipBackward].map(seen);
    assert!(often.iter().all(|&often| often > 8) && moving.mended == 0, "{often:?} of {}", moving.history.len());
    close("energy", energy.kinetic, work, 1e-9);
}
