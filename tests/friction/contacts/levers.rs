//! Frictions where the lever of a joint changes: by hand, several together, and in dead centres.

use linkage::contact::ReducedEquations;
use linkage::{Mode, Scene, StateParts};

use super::machines::*;
use linkage_oracle::close;

use super::moving::{Moving, run};

/// The slider by hand: z = r cos phi + sqrt(l^2 - r^2 sin^2 phi), M = j + m z_1^2, Q = t0 - m z_1 z_2 phi'^2 - F z_1,
/// by the classical method of Runge and Kutta from dead centre to dead centre, where the friction changes its sign.
#[test]
fn a_slider_with_friction_by_hand() {
    let scene = Guided::default();
    let (r, l) = (0.1, 0.35_f64);
    let slider = |phi: f64| {
        let root = (l * l - r * r * phi.sin().powi(2)).sqrt();
        let first = -r * phi.sin() - r * r * phi.sin() * phi.cos() / root;
        let second =
            -r * phi.cos() - r * r * (2.0 * phi).cos() / root - (r * r * phi.sin() * phi.cos()).powi(2) / root.powi(3);
        (first, second)
    };
    // By phi instead of t, so that dead centres are ends of steps: t' = 1 / w, w' = w'' / w.
    let rate = |phi: f64, w: f64, sign: f64| {
        let (first, second) = slider(phi);
        let force = 3.0 - 0.8 * first * second * w * w - sign * 0.2 * 40.0 * first;
        [1.0 / w, force / (0.02 + 0.8 * first * first) / w]
    };
    let (mut phi, mut t, mut w) = (0.5_f64, 0.0, 12.0);
    let mut turns = Vec::new();
    for part in 1..=3 {
        let next = f64::from(part) * std::f64::consts::PI;
        let (steps, begun) = (4000, phi);
        let h = (next - begun) / f64::from(steps);
        let sign = slider(0.5 * (phi + next)).0.signum();
        for step in 0..steps {
            phi = begun + h * f64::from(step);
            let a = rate(phi, w, sign);
            let b = rate(phi + h / 2.0, w + h / 2.0 * a[1], sign);
            let c = rate(phi + h / 2.0, w + h / 2.0 * b[1], sign);
            let d = rate(phi + h, w + h * c[1], sign);
            t += h / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + d[0]);
            w += h / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + d[1]);
        }
        phi = next;
        turns.push((t, w));
    }
    let psi = std::f64::consts::PI - (r * 0.5_f64.sin() / l).asin();
    let guess = MachineCoordinates { phi: 0.5, psi, z: 0.43 };
    let start = scene.start(0.0, &guess, &12.0.into()).unwrap();
    let end = run(&scene, start, turns[2].0 + 0.01);
    assert_eq!(end.events.len(), 3, "{:?}", end.events);
    for ((time, y, before, after), (t, w)) in end.events.iter().zip(turns) {
        close("time", *time, t, 1e-11);
        close("phi'", y[3], w, 1e-9);
        assert!(before[0] != after[0] && !after[0].is_held());
    }
}

/// A linkage of one input holds while |Q| is at most the sum of |S| limit over all its joints; with a growing torque,
/// all slip at that moment.
#[test]
fn joints_hold_together() {
    let scene = Jointed::default();
    let guess = MachineCoordinates { phi: 0.8, psi: 2.9, z: 0.4 };
    let start = scene.start(0.0, &guess, &0.0.into()).unwrap();
    let q = Jointed::parts(&start).q;
    let machine = &scene.mechanism;
    let ratios = machine.velocity_ratios(&machine.pose_at(&q)).unwrap();
    let (psi, z) = (ratios[0], ratios[1]);
    let limit = 0.2 * 90.0 * (0.01 + 0.012 * (1.0 - psi).abs() + 0.008 * psi.abs()) + 0.2 * 40.0 * z.abs();
    let end = run(&scene, start, limit / 3.0 + 0.1);
    // All at one moment, one change for each joint; the first decides for all.
    assert_eq!(end.events.len(), 4, "{:?}", end.events);
    let (t, y, before, after) = end.events[0];
    assert!(end.events[1..].iter().all(|later| (later.0, later.2, later.3) == (t, after, after)), "{:?}", end.events);
    assert_eq!((before, y), ([Mode::Stick; 4].into(), start));
    close("time", t, limit / 3.0, 1e-12);
    let forward = |ratio: f64| if ratio > 0.0 { Mode::SlipForward } else { Mode::SlipBackward };
    assert_eq!(after, [Mode::SlipForward, forward(1.0 - psi), forward(psi), forward(z)]);
    // Forces that hold are within their limits and carry the torque.
    let (moving, _) = Moving::start(&scene, 0.0, &start).unwrap();
    let equations = ReducedEquations::of(&scene, 0.999_999 * limit / 3.0, &start).unwrap();
    let motion = moving.contacts.motion(&equations).unwrap();
    let limits = [0.2 * 90.0 * 0.01, 0.2 * 90.0 * 0.012, 0.2 * 90.0 * 0.008, 0.2 * 40.0];
    let work = motion.forces.dot(&[1.0, 1.0 - psi, psi, z].into());
    close("torque", -work, 0.999_999 * limit, 1e-14);
    for (force, limit) in motion.forces.iter().zip(limits) {
        assert!(force.abs() <= limit * (1.0 + 1e-12), "{force} {limit}");
    }
    assert_eq!(motion.acceleration[0], 0.0);
}

/// At rest at a dead centre a slider has no lever, and the effect of its friction shows only in motion: the energy is
/// the work of the torque less that of the friction.
#[test]
fn a_start_at_a_dead_centre() {
    for (centre, t0) in [(0.0, 3.0), (0.0, -3.0), (std::f64::consts::PI, 3.0), (std::f64::consts::PI, -3.0)] {
        let scene = Guided { t0, ..Guided::default() };
        let guess = MachineCoordinates { phi: centre, psi: 3.1, z: 0.35 + 0.1 * f64::cos(centre) };
        let start = scene.start(0.0, &guess, &0.0.into()).unwrap();
        let end = run(&scene, start, 0.12);
        let StateParts { q, input_rates: rates } = Guided::parts(&end.y);
        let kinetic = 0.5 * scene.mass_matrix(&q).unwrap()[0] * rates.phi * rates.phi;
        let turned = (q.phi - centre).abs();
        assert!(turned > 0.5 && turned < 3.0, "{turned}");
        close("energy", kinetic, 3.0 * turned - 8.0 * (guess.z - q.z).abs(), 1e-11);

        let scene = Scotch { torque: t0, ..Scotch::default() };
        let guess = YokeCoordinates { phi: centre, x: 0.1 * f64::cos(centre) };
        let end = run(&scene, scene.start(0.0, &guess, &0.0.into()).unwrap(), 0.12);
        let StateParts { q, input_rates: rates } = Scotch::parts(&end.y);
        let kinetic = 0.5 * scene.mass_matrix(&q).unwrap()[0] * rates.phi * rates.phi;
        close("energy", kinetic, 3.0 * (q.phi - centre).abs() - 8.0 * (guess.x - q.x).abs(), 1e-11);
    }
}
