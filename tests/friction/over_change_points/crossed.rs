//! A crossed parallelogram: tan(psi/2) = -k tan(theta/2), k = (b + a)/(b - a), through all change points.

use linkage::integrate::{Tolerance, dop853};
use linkage::linkage;
use linkage::simulation::{Start, simulate};
use nalgebra::{SVector, vector};
use rand::Rng;

use crate::over_change_points::comparison::{Case, compare};

linkage! {
    #[derive(Debug, Clone)]
    mechanism Crossed {
        param a = 1, b = 2, j1 = 5, j2 = 3, torque = 0, w = 2;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = b@0 + a@psi;
        body left { inertia j1; angle theta; }
        body right { inertia j2; angle psi; }
        scene Spinning { inertia; torque torque * cos(w * t) on theta; }
    }
}

/// psi' / theta' and its derivative by theta.
fn ratio(k: f64, theta: f64) -> (f64, f64) {
    let (sine, cosine) = (theta / 2.0).sin_cos();
    let size = cosine * cosine + k * k * sine * sine;
    (-k / size, k * (k * k - 1.0) * sine * cosine / (size * size))
}

/// A start, the inertia of the other crank, and the largest torque.
struct Spin {
    b: f64,
    theta: f64,
    rate: f64,
    j2: f64,
    torque: f64,
}

impl Spin {
    fn case(self) -> Case {
        let Self { b, theta, rate, j2, torque } = self;
        let k = (b + 1.0) / (b - 1.0);
        let mut scene = Spinning { torque, ..Spinning::default() };
        (scene.mechanism.b, scene.j2) = (b, j2);
        let (j1, w, end) = (scene.j1, scene.w, 4.0);
        // The angle psi from theta, turns included.
        let psi = move |theta: f64| {
            let turns = (theta / std::f64::consts::TAU).round();
            let rest = theta - turns * std::f64::consts::TAU;
            -2.0 * (k * (rest / 2.0).sin()).atan2((rest / 2.0).cos()) - turns * std::f64::consts::TAU
        };
        let reference = move |position: f64, by: f64| {
            let start = [theta + position * (1.0 + theta.abs()), rate + by * (6.0 + rate.abs())];
            // M theta'' = torque - M' theta'^2 / 2 with M = j1 + j2 (psi' / theta')^2.
            let law = move |t: f64, y: &SVector<f64, 2>| {
                let (r, slope) = ratio(k, y[0]);
                Ok(vector![y[1], (torque * (w * t).cos() - j2 * r * slope * y[1] * y[1]) / (j1 + j2 * r * r)])
            };
            let tolerance = Tolerance::new(1e-13, [1.0, 6.0]).unwrap();
            let mut motion = dop853(law, (0.0, SVector::from(start)), end, tolerance).unwrap();
            motion.finish(|_, _| true).unwrap();
            let theta = motion.state()[0];
            vec![theta, psi(theta)]
        };
        let motion = move |tolerance| {
            // The coupler by its loop.
            let angle = psi(theta);
            let coupler = (angle.sin() - theta.sin()).atan2(b + angle.cos() - theta.cos());
            let q = CrossedCoordinates { theta, phi: coupler, psi: angle };
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: rate }, end, tolerance)?;
            motion.finish(|_, _| true)?;
            let q = motion.state().q;
            Ok((vec![q.theta, q.psi], motion.passages().change_points))
        };
        Case { motion: Box::new(motion), reference: Box::new(reference) }
    }
}

#[test]
fn a_crossed_parallelogram_stays_crossed() {
    compare("crossed", 16, 5, |random| {
        let b = random.random_range(1.2..4.0);
        let (theta, rate) = (random.random_range(-3.0..3.0), random.random_range(-6.0..6.0));
        let (j2, torque) = (random.random_range(0.5..5.0), random.random_range(-5.0..5.0));
        Spin { b, theta, rate, j2, torque }.case()
    });
}

/// The motion begins on its sheet some half lengths before the crossing, next to another change point, and in the order of
/// elimination one pivot is small there while the other is large; at 1e-4 a step ends next to another change point.
#[test]
fn change_points_near_each_other() {
    let spins = [
        (
            1e-6,
            Spin {
                b: 1.2020205331821356,
                theta: -0.2316067260017034,
                rate: 3.09952464681897,
                j2: 3.92982392927425,
                torque: 0.9746141154197918,
            },
        ),
        (
            1e-6,
            Spin {
                b: 1.2101909506476376,
                theta: -2.944665980737473,
                rate: -5.189733619152371,
                j2: 1.8682785780536375,
                torque: 0.21388644769822207,
            },
        ),
        (
            1e-4,
            Spin {
                b: 1.3699853765879597,
                theta: -1.7083237581535156,
                rate: 4.400267225180478,
                j2: 0.7223873591409137,
                torque: 1.583183644332486,
            },
        ),
        // A step in the inputs passes a change point, and is repeated in other coordinates.
        (
            1e-4,
            Spin {
                b: 3.660738583817084,
                theta: -2.649682629663485,
                rate: -5.117652276160556,
                j2: 2.737513295994984,
                torque: 1.9034572104121246,
            },
        ),
    ];
    for (tolerance, spin) in spins {
        let Case { motion, reference } = spin.case();
        let ((found, _), right) = (motion(tolerance).unwrap(), reference(0.0, 0.0));
        assert!((found[0] - right[0]).abs() < 300.0 * tolerance, "{found:?} {right:?}");
    }
}
