//! A block on a wedge: it slides down and pushes the wedge aside, unless the angle is within the angle of friction.

use linkage::simulation::{Start, simulate};
use linkage::{Mode, linkage};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Wedge {
        param alpha = 20deg, h = 1;
        param m1 = 2, m2 = 3, mu = 0.2, g = 9.81;
        input x;
        unknown y, s;
        loop (x, 0) + s@(pi - alpha) = (h, y);
        body wedge { mass m1; center (x, 0); }
        body block { mass m2; center (h, y); }
        scene Released {
            inertia;
            gravity (0, -g);
            friction mu, reaction on s;
            reaction on s;
            reaction on x;
            energy;
            power;
        }
    }
}

/// A wedge of this angle with this coefficient of friction.
fn wedge(alpha: f64, mu: f64) -> Released<f64> {
    Released { mechanism: Wedge { alpha, h: 1.0 }, mu, ..Released::default() }
}

fn at(scene: &Released<f64>, x: f64) -> WedgeCoordinates<f64> {
    let place = scene.mechanism.branches(x).unwrap().next().unwrap();
    place.pose.coordinates()
}

#[test]
fn it_locks_exactly_at_the_angle_of_friction() {
    let mut random = SmallRng::seed_from_u64(20);
    for _ in 0..200 {
        let alpha: f64 = random.random_range(0.02..1.4);
        for (mu, is_locked) in
            [(alpha.tan(), true), (alpha.tan() * (1.0 + 1e-12), true), (alpha.tan() * (1.0 - 1e-12), false)]
        {
            let scene = wedge(alpha, mu);
            let q = at(&scene, random.random_range(-2.0..2.0));
            let simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 1.0, 1e-9).unwrap();
            let mode = simulation.state().contacts[0].mode;
            assert_eq!(mode == Mode::Stick, is_locked, "{alpha} {mu}: {mode:?}");
            let loads = simulation.loads().unwrap();
            let close = |found: f64, expected: f64| {
                assert!((found - expected).abs() <= 1e-11 * scene.m2 * scene.g, "{alpha} {mu}: {found} {expected}");
            };
            if is_locked {
                // The weight alone: normal to the incline, and along it.
                close(loads.joints.s_normal.abs(), scene.m2 * scene.g * alpha.cos());
                close(loads.contacts[0].abs(), scene.m2 * scene.g * alpha.sin());
                close(loads.joints.x_normal, (scene.m1 + scene.m2) * scene.g);
            }
        }
    }
}

/// With the block on a vertical guide, N = m2 (g + a tan a) / (cos a + mu sin a) and m1 a = N (sin a - mu cos a).
#[test]
fn it_slides_by_the_closed_form() {
    let mut random = SmallRng::seed_from_u64(21);
    for _ in 0..200 {
        let alpha: f64 = random.random_range(0.1..1.3);
        let mu = alpha.tan() * random.random_range(0.0..0.99);
        let scene = wedge(alpha, mu);
        let q = at(&scene, 0.3);
        let (sine, cosine) = (alpha.sin(), alpha.cos());
        let push = (sine - mu * cosine) / (cosine + mu * sine);
        // a of the wedge; the block falls with a tan alpha.
        let a = scene.m2 * scene.g * push / (scene.m1 + scene.m2 * alpha.tan() * push);
        let normal = scene.m1 * a / (sine - mu * cosine);
        let joints = scene.reactions(0.0, &q, 0.0).unwrap();
        assert!((joints.s_normal.abs() / normal - 1.0).abs() < 1e-12, "{alpha} {mu}: {} {normal}", joints.s_normal);
        let t = 0.05;
        let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, t, 1e-10).unwrap();
        simulation.finish(|_, _| true).unwrap();
        let moved = simulation.state().q.x - q.x;
        assert!((moved + a * t * t / 2.0).abs() < 1e-9 * a, "{alpha} {mu}: {moved} {a}");
    }
}

#[test]
fn a_joint_without_load_has_no_friction() {
    let mut scene = wedge(0.4, 0.3);
    scene.g = 0.0;
    let q = at(&scene, 0.3);
    let mut simulation = simulate(&scene, Start { t: 0.0, q, input_rates: 1.5 }, 1.0, 1e-9).unwrap();
    simulation.finish(|_, _| true).unwrap();
    assert!((simulation.state().q.x - q.x - 1.5).abs() < 1e-9);
    assert_eq!(simulation.loads().unwrap().contacts[0], 0.0);
}
