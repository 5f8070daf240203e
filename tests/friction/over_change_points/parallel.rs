//! A parallelogram with a torque, and with a stop: one rotor.

use linkage::integrate::Crossing;
use linkage::linkage;
use linkage::simulation::{Start, Then, simulate};
use rand::Rng;

use crate::over_change_points::comparison::{Case, compare};

linkage! {
    /// Two cranks, a bar that stays level, and a torque that swings.
    #[derive(Debug, Clone)]
    mechanism Cranks {
        param a = 0.1, b = 0.3, j = 0.01, m = 1, t0 = 0.1, w = 3, p = 0, lo = -100, hi = 3.3, e = 0.5;
        input th;
        unknown ph, ps;
        loop a@th + b@ph = (b, 0) + a@ps;
        body left { inertia j; angle th; }
        body right { inertia j; angle ps; }
        body bar { mass m; inertia 0.01; center a@th + (b/2)@ph; angle ph; }
        scene Smooth { inertia; torque t0 * sin(w*t + p) on th; }
        scene Stopped { inertia; torque t0 * sin(w*t + p) on th; stop th in lo..hi, restitution e; }
    }
}

linkage! {
    /// One axis with the same inertia.
    #[derive(Debug, Clone)]
    mechanism Rotor {
        param j = 0.03, t0 = 0.1, w = 3, p = 0, lo = -100, hi = 3.3, e = 0.5;
        input th;
        body rotor { inertia j; angle th; }
        scene Alone { inertia; torque t0 * sin(w*t + p) on th; stop th in lo..hi, restitution e; }
    }
}

/// theta'' = t0 sin(w t + p) / M, integrated twice.
#[test]
fn smooth_motions_are_those_of_a_rotor() {
    compare("smooth", 40, 5, |random| {
        let (th, v, p) =
            (random.random_range(0.0..6.3_f64), random.random_range(-0.6..0.6_f64), random.random_range(0.0..6.3));
        let scene = Smooth { p, ..Smooth::default() };
        let (inertia, w, t0) = (0.03, scene.w, scene.t0);
        let times = [1.7, 3.1, 4.9, 6.4, 8.3, 10.0];
        let reference = move |position: f64, rate: f64| {
            let (th, v) = (th + position * (1.0 + th.abs()), v + rate * (2.0 + v.abs()));
            let angle = |t: f64| {
                let turned = t0 / (inertia * w * w) * ((w * t + p).sin() - p.sin());
                th + (v + t0 * p.cos() / (inertia * w)) * t - turned
            };
            times.map(angle).into_iter().flat_map(|angle| [angle, angle, 0.0]).collect()
        };
        // An event of the user at each half turn from a random angle: it is located, and changes nothing. Its functions
        // have the error of the step, and the state is projected.
        let mark = random.random_range(0.0..3.0_f64);
        let motion = move |tolerance| {
            let q = CranksCoordinates { th, ph: 0.0, ps: th };
            let motion = simulate(&scene, Start { t: 0.0, q, input_rates: v }, times[5], tolerance)?;
            let mut motion = motion.events(
                [Crossing::Either],
                |state| Ok([f64::sin(state.q.ps - mark)]),
                |_, state| {
                    assert!(f64::sin(state.q.ps - mark).abs() < 1e-12 + 100.0 * tolerance, "{state:?}");
                    Ok(Then::GoOn)
                },
            )?;
            let mut found = Vec::new();
            for state in motion.at(times) {
                let q = state?.q;
                found.extend([q.th, q.ps, q.ph]);
            }
            Ok((found, motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    });
}

#[test]
fn stopped_motions_are_those_of_a_rotor() {
    compare("stopped", 24, 5, |random| {
        let near = random.random_bool(0.5);
        let hi =
            if near { std::f64::consts::PI + random.random_range(-0.2..0.2) } else { random.random_range(2.0..8.0) };
        let th = hi - random.random_range(0.05..3.0);
        let (v, p, e) = (
            random.random_range(-0.6..0.6_f64),
            random.random_range(0.0..6.3),
            f64::from(random.random_range(0..=10)) / 10.0,
        );
        let scene = Stopped { p, hi, e, ..Stopped::default() };
        let rotor = Alone { p, hi, e, ..Alone::default() };
        let reference = move |position: f64, rate: f64| {
            let (th, v) = (th - position.abs() * (1.0 + th.abs()), v + rate * (2.0 + v.abs()));
            let start = Start { t: 0.0, q: RotorCoordinates { th }, input_rates: v };
            let mut motion = simulate(&rotor, start, 6.0, 1e-13).unwrap();
            motion.finish(|_, _| true).unwrap();
            let th = motion.state().q.th;
            vec![th, th, 0.0]
        };
        let motion = move |tolerance| {
            let q = CranksCoordinates { th, ph: 0.0, ps: th };
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: v }, 6.0, tolerance)?;
            motion.finish(|_, _| true)?;
            let q = motion.state().q;
            Ok((vec![q.th, q.ps, q.ph], motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    });
}
