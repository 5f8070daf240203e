//! A parallelogram that carries a sprung block: two inputs, whose change points are a line in the plane of both.

use linkage::linkage;
use linkage::simulation::{Start, simulate};
use rand::Rng;

use crate::over_change_points::comparison::{Case, compare};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Tray {
        param a = 1, d = 2, m = 1.2, j = 2, k = 20, g = 9.81, end = 1.2, e = 0.5;
        input theta, s;
        unknown phi, psi;
        loop a@theta + d@phi = d@0 + a@psi;
        body crank { inertia j; angle theta; }
        body rocker { inertia j; angle psi; }
        body block { mass m; center a@theta + s@phi; }
        scene Carried { inertia; gravity (0, -g); potential k/2 * (s - 1)^2; stop s in 0..end, restitution e; }
    }
}

linkage! {
    /// A tray that is level.
    #[derive(Debug, Clone)]
    mechanism Level {
        param a = 1, m = 1.2, j = 4, k = 20, g = 9.81, end = 1.2, e = 0.5;
        input theta, s;
        body crank { inertia j; angle theta; }
        body block { mass m; center a@theta + s@0; }
        scene Alone { inertia; gravity (0, -g); potential k/2 * (s - 1)^2; stop s in 0..end, restitution e; }
    }
}

#[test]
fn a_block_on_a_level_tray() {
    compare("tray", 8, 5, |random| {
        let (theta, s) = (random.random_range(-3.0..3.0_f64), random.random_range(0.7..1.1_f64));
        let rates = [random.random_range(-5.0..5.0_f64), random.random_range(-1.0..1.0_f64)];
        let (end, e) = (random.random_range(1.1..2.0), f64::from(random.random_range(0..=4)) / 4.0);
        let scene = Carried { end, e, ..Carried::default() };
        let alone = Alone { end, e, ..Alone::default() };
        let time = 2.0;
        let reference = move |position: f64, by: f64| {
            let q = LevelCoordinates { theta: theta + position * (1.0 + theta.abs()), s: s - position.abs() };
            let input_rates = LevelInputs {
                theta: rates[0] + by * (5.0 + rates[0].abs()),
                s: rates[1] + by * (5.0 + rates[1].abs()),
            };
            let mut motion = simulate(&alone, Start { t: 0.0, q, input_rates }, time, 1e-13).unwrap();
            motion.finish(|_, _| true).unwrap();
            let q = motion.state().q;
            vec![q.theta, q.theta, 0.0, q.s]
        };
        let motion = move |tolerance| {
            let q = TrayCoordinates { theta, s, phi: 0.0, psi: theta };
            let input_rates = TrayInputs { theta: rates[0], s: rates[1] };
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates }, time, tolerance)?;
            motion.finish(|_, _| true)?;
            let q = motion.state().q;
            Ok((vec![q.theta, q.psi, q.phi, q.s], motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    });
}
