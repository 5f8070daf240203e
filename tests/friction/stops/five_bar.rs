//! Arms that come into line, where both cranks are bad inputs, and stop there: in two choices of inputs, each impact by
//! Newton's law for two coordinates.

use std::f64::consts::PI;

use linkage::contact::Change;
use linkage::nalgebra::{RowVector2, Vector2};
use linkage::simulation::{Start, Touch, simulate};
use linkage::{Mechanism, Mode, linkage};

use linkage_oracle::close;

use super::POSITION_ERROR;

linkage! {
    /// A five-bar on a table whose springs pull its arms straight.
    #[derive(Debug, Clone)]
    mechanism Arms {
        param a = 0.7, b = 1.6, c = 1.5, d = 0.8, e = 1.7, m = 2, j1 = 0.2, j4 = 0.1, j2 = 0.9, j3 = 0.7;
        param k = 40, part = 0.5;
        coordinate theta1, theta2, theta3, theta4;
        loop a@theta1 + b@theta2 = e@0 + d@theta4 + c@theta3;
        drive Cranks by theta1, theta4;
        drive Chain by theta1, theta2;
        output bend = theta3 - theta2 - 180deg;
        output fold = 2 * theta2 - 2 * theta3 + 360deg;
        body left { inertia j1; angle theta1; }
        body arm { mass m; inertia j2; center a@theta1 + (b/2)@theta2; angle theta2; }
        body forearm { mass m; inertia j3; center e@0 + d@theta4 + (c/2)@theta3; angle theta3; }
        body right { inertia j4; angle theta4; }
        scene BentOnCranks of Cranks { inertia; spring k, 1 on bend; stop bend in -2..0, restitution part; }
        scene BentOnChain of Chain { inertia; spring k, 1 on bend; stop bend in -2..0, restitution part; energy; }
        scene FoldedOnCranks of Cranks { inertia; spring k / 4, -2 on fold; stop fold in 0..4, restitution part; }
        scene FoldedOnChain of Chain { inertia; spring k / 4, -2 on fold; stop fold in 0..4, restitution part; }
    }
}

/// The time, the position, its rates, and the stop: equal for both choices of inputs.
type Moment = (f64, ArmsCoordinates, ArmsRates, Touch);

/// The energy account of one run: all losses are in impacts. Returns the times of the impacts.
fn account(scene: &BentOnChain<f64>, moments: &[Moment]) -> Vec<f64> {
    let chain = &scene.mechanism;
    let energy = |(_, q, rates, _): &Moment| {
        let energy = scene.energy(q, ChainInputs { theta1: rates.theta1, theta2: rates.theta2 }).unwrap();
        energy.kinetic + energy.potential
    };
    let (whole, mut taken, mut times) = (energy(&moments[0]), 0.0, Vec::new());
    for moment in moments {
        let (t, q, rates, touch) = moment;
        close("energy", energy(moment), whole - taken, 1e-10 * whole);
        let (bend, turn) = (q.theta3 - q.theta2 - PI, rates.theta3 - rates.theta2);
        let is_open = touch.mode == Mode::Open;
        // A coordinate at rest keeps its rate to rounding error, and its position to the error of the steps.
        let drift = if is_open { POSITION_ERROR } else { 1e-11 };
        assert!(bend < drift, "{bend:e} at {t}");
        let Some(change) = touch.change else {
            let rests = bend.abs() < drift && turn.abs() < 64.0 * f64::EPSILON * rates.theta2.abs();
            assert!(rests || is_open, "{moment:?} {bend:e} {turn:e}");
            continue;
        };
        assert!(matches!(change, Change::Impact | Change::Rests), "{change:?} at {t}");
        times.push(*t);
        // s' goes to -e s' by an impulse along S: T falls by (1 - e^2) s'^2 / (2 S M^-1 S').
        let ratios = chain.velocity_ratios(&chain.pose_at(q)).unwrap();
        let theta3 = <Chain<f64> as Mechanism>::UNKNOWNS.iter().position(|&name| name == "theta3").unwrap();
        let row = RowVector2::new(ratios[(theta3, 0)], ratios[(theta3, 1)] - 1.0);
        let mass = scene.mass_matrix(q).unwrap();
        let answer = (row * mass.try_inverse().unwrap() * row.transpose())[0];
        let rate = (row * Vector2::new(rates.theta1, rates.theta2))[0];
        let part = if change == Change::Rests { 0.0 } else { scene.part };
        taken += (1.0 - part * part) * rate * rate / (2.0 * answer);
    }
    times
}

/// Lengths times `size`, and the other parameters by their squares.
macro_rules! scaled {
    ($scene:ident, $size:expr, $part:expr) => {{
        let (mut scene, square) = ($scene::<f64> { part: $part, ..$scene::default() }, $size * $size);
        let lengths = &mut scene.mechanism;
        for length in [&mut lengths.a, &mut lengths.b, &mut lengths.c, &mut lengths.d, &mut lengths.e] {
            *length *= $size;
        }
        for of_square in [&mut scene.k, &mut scene.j1, &mut scene.j2, &mut scene.j3, &mut scene.j4] {
            *of_square *= square;
        }
        scene
    }};
}

macro_rules! moments {
    ($scene:expr, $q:expr, $inputs:ident { $($input:ident),* }) => {{
        let scene = &$scene;
        let mut motion = simulate(scene, Start { t: 0.0, q: $q, input_rates: $inputs { $($input: 0.0),* } }, 1.2, 1e-13).unwrap();
        let mut states = vec![*motion.state()];
        while let Some(state) = motion.advance().unwrap() {
            let last = states[states.len() - 1].t;
            let times = (1..4).map(|part| last + (state.t - last) * f64::from(part) / 4.0);
            states.extend(motion.at(times).map(Result::unwrap));
            states.push(state);
        }
        states.iter().map(|state| (state.t, state.q, state.rates, state.contacts[0])).collect::<Vec<Moment>>()
    }};
}

#[test]
fn arms_that_stop_in_line() {
    for size in [1e-3, 1.0, 1e3] {
        for part in [0.0, 0.2, 0.5] {
            let scene = scaled!(BentOnChain, size, part);
            let near = ArmsCoordinates { theta1: 2.6, theta2: 0.3, theta3: 2.9, theta4: 0.8 };
            let q = scene.mechanism.solve(&near).unwrap().coordinates;
            let runs = [
                moments!(scene, q, ChainInputs { theta1, theta2 }),
                moments!(scaled!(BentOnCranks, size, part), q, CranksInputs { theta1, theta4 }),
                moments!(scaled!(FoldedOnChain, size, part), q, ChainInputs { theta1, theta2 }),
                moments!(scaled!(FoldedOnCranks, size, part), q, CranksInputs { theta1, theta4 }),
            ];
            let times = runs.each_ref().map(|moments| account(&scene, moments));
            assert!(if part == 0.0 { times[0].len() == 1 } else { times[0].len() > 8 }, "{times:?}");
            for others in &times[1..] {
                assert_eq!(others.len(), times[0].len());
                for (time, other) in times[0].iter().zip(others) {
                    close("time", *other, *time, 1e-8);
                }
            }
        }
    }
}
