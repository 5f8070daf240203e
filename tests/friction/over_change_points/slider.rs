//! A slider-crank with equal rods, psi = -phi, whose slider passes the crank's axis; a spring and a stop.

use linkage::linkage;
use linkage::simulation::{Start, simulate};
use rand::Rng;

use crate::over_change_points::comparison::{Case, compare};

linkage! {
    #[derive(Debug, Clone)]
    mechanism EqualRods {
        param r = 0.1, j = 0.01, m = 1, k = 500, l0 = 0.03, at = 0.05, least = -1, e = 0.5;
        input phi;
        unknown psi, s;
        loop r@phi + r@psi = (s, 0);
        body crank { inertia j; angle phi; }
        body rod { inertia j/2; angle psi; }
        body slider { mass m; center (s, 0); }
        scene Sprung { inertia; spring k, l0 between (at, at/2) and (s, 0); stop s in least..1, restitution e; }
    }
}

linkage! {
    /// One angle instead of the loop.
    #[derive(Debug, Clone)]
    mechanism Angle {
        param r = 0.1, j = 0.01, m = 1, k = 500, l0 = 0.03, at = 0.05, least = -1, e = 0.5;
        input phi;
        let s = 2 * r * cos(phi);
        body crank { inertia j; angle phi; }
        body rod { inertia j/2; angle -phi; }
        body slider { mass m; center (s, 0); }
        output way = s;
        scene Alone { inertia; spring k, l0 between (at, at/2) and (s, 0); stop way in least..1, restitution e; }
    }
}

#[test]
fn the_slider_passes_the_axis() {
    compare("equal rods", 16, 5, |random| {
        let (phi, rate) = (random.random_range(-1.4..1.4_f64), random.random_range(-8.0..8.0_f64));
        let (k, least) = (random.random_range(50.0..500.0), random.random_range(-0.3..-0.02_f64));
        // With e = 0 the slider later returns to the stop with the rate zero, and an error of the energy counts with its
        // root.
        let e = f64::from(random.random_range(1..=4)) / 4.0;
        let scene = Sprung { k, least, e, ..Sprung::default() };
        let alone = Alone { k, least, e, ..Alone::default() };
        let end = 1.5;
        let reference = move |position: f64, by: f64| {
            // Moved again at each twelfth, as each step of a simulation is: at the start, near the top of the potential, a
            // move changes the energy by its square.
            let (mut t, mut phi, mut rate) = (0.0, phi, rate);
            for part in 1..=12 {
                let at = |phi, input_rates| Start { t, q: AngleCoordinates { phi }, input_rates };
                let moved = at(phi + position * (1.0 + phi.abs()), rate + by * (10.0 + rate.abs()));
                let until = end * f64::from(part) / 12.0;
                // Next to the stop a move may be beyond it.
                let motion = simulate(&alone, moved, until, 1e-13);
                let mut motion = motion.or_else(|_| simulate(&alone, at(phi, rate), until, 1e-13)).unwrap();
                t = until;
                motion.finish(|_, _| true).unwrap();
                (phi, rate) = (motion.state().q.phi, motion.state().rates.phi);
            }
            vec![phi, -phi, 2.0 * phi.cos()]
        };
        let motion = move |tolerance| {
            let q = EqualRodsCoordinates { phi, psi: -phi, s: 0.2 * phi.cos() };
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: rate }, end, tolerance)?;
            motion.finish(|_, _| true)?;
            let q = motion.state().q;
            Ok((vec![q.phi, q.psi, q.s / 0.1], motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    });
}
