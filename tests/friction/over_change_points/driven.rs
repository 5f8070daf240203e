//! A driven parallelogram with a free pendulum on its bar: a prescribed input is among the coordinates of the sheet.

use linkage::linkage;
use linkage::simulation::{Start, simulate};
use rand::Rng;

use crate::over_change_points::comparison::{Case, compare};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Driven {
        param a = 1, d = 2, l = 0.5, m = 1.2, g = 9.81, from = 0, omega = 2, sway = 0.5, w = 3;
        input theta, alpha;
        unknown phi, psi;
        loop a@theta + d@phi = d@0 + a@psi;
        body bob { mass m; center a@theta + (d/2)@phi + l@alpha; }
        scene Carried { inertia; gravity (0, -g); drive theta = from + omega * t + sway * sin(w * t); }
    }
}

linkage! {
    /// A level bar that carries the same pendulum.
    #[derive(Debug, Clone)]
    mechanism Level {
        param a = 1, d = 2, l = 0.5, m = 1.2, g = 9.81, from = 0, omega = 2, sway = 0.5, w = 3;
        input theta, alpha;
        body bob { mass m; center a@theta + (d/2, 0) + l@alpha; }
        scene Alone { inertia; gravity (0, -g); drive theta = from + omega * t + sway * sin(w * t); }
    }
}

#[test]
fn a_pendulum_on_a_driven_bar() {
    compare("driven", 8, 5, |random| {
        let from = random.random_range(-3.0..3.0_f64);
        let (omega, sway) = (random.random_range(-4.0..4.0), random.random_range(-0.5..0.5));
        let (alpha, rate) = (random.random_range(-3.0..0.0_f64), random.random_range(-3.0..3.0_f64));
        let scene = Carried { from, omega, sway, ..Carried::default() };
        let alone = Alone { from, omega, sway, ..Alone::default() };
        let (time, start_rate) = (2.0, omega + sway * scene.w);
        let reference = move |position: f64, by: f64| {
            let q = LevelCoordinates { theta: from, alpha: alpha + position * (1.0 + alpha.abs()) };
            let input_rates = LevelInputs { theta: start_rate, alpha: rate + by * (5.0 + rate.abs()) };
            let mut motion = simulate(&alone, Start { t: 0.0, q, input_rates }, time, 1e-13).unwrap();
            motion.finish(|_, _| true).unwrap();
            let q = motion.state().q;
            vec![q.theta, q.theta, 0.0, q.alpha]
        };
        let motion = move |tolerance| {
            let q = DrivenCoordinates { theta: from, alpha, phi: 0.0, psi: from };
            let input_rates = DrivenInputs { theta: start_rate, alpha: rate };
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates }, time, tolerance)?;
            motion.finish(|_, _| true)?;
            let q = motion.state().q;
            Ok((vec![q.theta, q.psi, q.phi, q.alpha], motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    });
}
