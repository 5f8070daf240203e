//! Mechanisms followed along their motion: the guarantees of a path, besides the hard cases.

use approx::assert_abs_diff_eq;
use std::f64::consts::{PI, TAU};

use linkage::continuation::{Along, AlongCoordinates, AlongRates, Direction, Event, Options, Path, PathStep};
use linkage::{Column, Elbow, Mechanism, PathError, PositionError};
use nalgebra::{SVector, vector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::coupled_wheels::*;
use linkage_gallery::double_butterfly::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::offset_slider_crank::*;
use linkage_gallery::slider_crank::*;

fn left(m: &FourBar, theta2: f64) -> FourBarCoordinates {
    m.assemble(theta2, FourBarBranch::new(Elbow::Left)).unwrap().coordinates()
}

/// A rocker that drives: its dead points are where crank and coupler are in line.
fn rocker() -> FourBar {
    FourBar::new(80.0, 70.0, 50.0, 20.0)
}

/// A whole turn comes back to the start, past two dead points where crank and coupler are in line.
#[test]
fn a_turn_driven_by_the_rocker() {
    let m = rocker();
    let start = left(&m, 0.7);
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    let mut dead_points = Vec::new();
    loop {
        let step = path.advance_watching(|q, _| (q.theta4 - start.theta4).sin()).unwrap();
        match step.event {
            Some(Event::DeadPoint { group }) => {
                assert_eq!(group, "theta3, theta4");
                assert_abs_diff_eq!((step.position.theta3 - step.position.theta4).sin(), 0.0, epsilon = 1e-15);
                assert_abs_diff_eq!(step.rates.theta2, 0.0, epsilon = 1e-14);
                dead_points.push(step.position.theta2);
            }
            Some(Event::Zero) if (step.position.theta4 - start.theta4).abs() > 6.0 => break,
            _ => {}
        }
        assert!(step.length < 100.0);
    }
    let q = path.position();
    assert_abs_diff_eq!(q.theta2, start.theta2, epsilon = 1e-14);
    assert_abs_diff_eq!(q.theta3, start.theta3, epsilon = 1e-14);
    assert_abs_diff_eq!((q.theta4 - start.theta4).abs(), TAU, epsilon = 1e-14);
    // The rocker turns back where coupler and crank reach 70 and 30 together: by the law of cosines.
    let angle = |reach: f64| ((80.0_f64.powi(2) + 70.0_f64.powi(2) - reach * reach) / (2.0 * 80.0 * 70.0)).acos();
    dead_points.sort_by(f64::total_cmp);
    assert_eq!(dead_points.len(), 2);
    assert_abs_diff_eq!(dead_points[0], angle(30.0), epsilon = 1e-14);
    assert_abs_diff_eq!(dead_points[1], angle(70.0), epsilon = 1e-14);
}

/// A path follows an input that changes by less than the rounding errors of the unknowns, up and down: by one ulp, and near zero,
/// where an ulp is much smaller than these errors. The position is the one in closed form at the new input.
#[test]
fn to_the_next_number() {
    let m = FourBar::default();
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(0x1e57));
    let mut count = 0;
    for _ in 0..linkage_trials::count("NEXT", 200, 2000) {
        let from: f64 = random.random_range(-PI..PI);
        let mut path = Path::new(&m, &left(&m, from), Direction::Increasing).unwrap();
        // On through zero, to places within 1e-16 and 1e-32 of it, and back.
        let tiny = random.random_range(-1e-16..1e-16_f64);
        let others = [0.0, tiny, tiny.next_up(), tiny.next_down(), -tiny, 1e-16 * tiny, f64::MIN_POSITIVE, -0.0, from];
        for target in [from.next_up(), from.next_down(), from].into_iter().chain(others) {
            let step = path.advance_to(target).unwrap_or_else(|error| panic!("{from} to {target:e}: {error}"));
            assert_eq!(step.position.theta2, target);
            let right = left(&m, target);
            assert_abs_diff_eq!(step.position.theta3, right.theta3, epsilon = 1e-14);
            assert_abs_diff_eq!(step.position.theta4, right.theta4, epsilon = 1e-14);
            count += 1;
        }
    }
    println!("{count} inputs");
}

/// The rates along the path are those that the velocity ratios give.
#[test]
fn rates_are_velocity_ratios() {
    let m = FourBar::default();
    let path = Path::new(&m, &left(&m, 0.35), Direction::Decreasing).unwrap();
    for step in path.take(100) {
        let PathStep { position, rates, .. } = step.unwrap();
        assert!(rates.theta2 < 0.0);
        let w = m.velocity_ratios(&m.pose_at(&position)).unwrap();
        assert_abs_diff_eq!(rates.theta3, w[0] * rates.theta2, epsilon = 1e-13);
        assert_abs_diff_eq!(rates.theta4, w[1] * rates.theta2, epsilon = 1e-13);
        assert_abs_diff_eq!(rates.theta2.hypot(rates.theta3).hypot(rates.theta4), 1.0, epsilon = 1e-14);
    }
}

/// The zero of an output is found to rounding error: the right transmission angle.
#[test]
fn zero_of_an_output() {
    let m = FourBar::default();
    let right_angle = |q: &FourBarCoordinates, _: &FourBarRates| m.outputs(&m.pose_at(q)).unwrap().mu.cos();
    let mut path = Path::new(&m, &left(&m, 0.35), Direction::Increasing).unwrap();
    let mut found = Vec::new();
    while path.position().theta2 < 0.35 + TAU {
        let step = path.advance_watching(right_angle).unwrap();
        if step.event == Some(Event::Zero) {
            assert_abs_diff_eq!((step.position.theta3 - step.position.theta4).cos(), 0.0, epsilon = 1e-15);
            found.push(step.position.theta2);
        }
    }
    // B is then sqrt(50^2 + 70^2) from D.
    let expected = ((80.0_f64.powi(2) + 20.0_f64.powi(2) - 7400.0) / (2.0 * 80.0 * 20.0)).acos();
    assert_eq!(found.len(), 2);
    assert_abs_diff_eq!(found[0], expected, epsilon = 1e-14);
    assert_abs_diff_eq!(found[1], TAU - expected, epsilon = 1e-14);
}

/// A range is kept at both ends, to the last digit.
#[test]
fn limits_of_the_range() {
    let m = FourBar::default();
    let options = Options { range: Some([-1.0, 0.7]), ..Options::default() };
    let mut path = Path::with(&m, &left(&m, 0.35), Direction::Increasing, options).unwrap();
    for (end, other) in [(0.7, -1.0), (-1.0, 0.7)] {
        let last = path.by_ref().last().unwrap().unwrap();
        assert_eq!((last.event, last.position.theta2), (Some(Event::Limit), end));
        assert!(path.next().is_none());
        assert_eq!(path.advance().unwrap().position, last.position);
        assert!(path.advance_to(end + (end - other)).is_err());
        path.turn_back();
    }
}

/// Scaling all lengths by a power of two changes exponents only.
#[test]
fn scale_free() {
    let four_bar = FourBar::default();
    let start = left(&four_bar, 0.35);
    let steps = |m: &FourBar| -> Vec<_> {
        Path::new(m, &start, Direction::Increasing).unwrap().take(60).map(Result::unwrap).collect()
    };
    let reference = steps(&four_bar);
    let rocker_steps = |m: &FourBar, start| -> Vec<_> {
        Path::new(m, &start, Direction::Increasing).unwrap().take(60).map(Result::unwrap).collect()
    };
    let of_rocker = rocker_steps(&rocker(), left(&rocker(), 0.7));
    assert!(of_rocker.iter().any(|step| step.event.is_some()));
    let wheels = CoupledWheelsCoordinates { theta: 0.4, rod: 0.0, follower: 0.4 };
    let wheels_steps = |m: &CoupledWheels| -> Vec<_> {
        Path::new(m, &wheels, Direction::Increasing).unwrap().take(60).map(Result::unwrap).collect()
    };
    let of_wheels = wheels_steps(&CoupledWheels::default());
    let engine = Engine::new(0.15, 0.3);
    let phi2 = -(0.5 * 1_f64.sin()).asin();
    let engine_start = SliderCrankCoordinates { z3: 0.15 * 1_f64.cos() + 0.3 * phi2.cos(), phi1: 1.0, phi2 };
    let engine_steps = |m: &Engine, start| -> Vec<_> {
        Path::new(m, &start, Direction::Increasing).unwrap().take(60).map(Result::unwrap).collect()
    };
    let of_engine = engine_steps(&engine, engine_start);
    for k in [-300, -40, 13, 300] {
        let scale = 2_f64.powi(k);
        assert_eq!(steps(&four_bar.clone().map(|length| length * scale)), reference);
        assert_eq!(rocker_steps(&rocker().map(|length| length * scale), left(&rocker(), 0.7)), of_rocker);
        assert_eq!(wheels_steps(&CoupledWheels::default().map(|length| length * scale)), of_wheels);
        let scaled = SliderCrankCoordinates { z3: engine_start.z3 * scale, ..engine_start };
        for (found, expected) in engine_steps(&engine.clone().map(|z| z * scale), scaled).iter().zip(&of_engine) {
            assert_eq!(found.position.z3, expected.position.z3 * scale);
            assert_eq!((found.position.phi1, found.position.phi2), (expected.position.phi1, expected.position.phi2));
            assert_eq!((found.length, found.event.is_some()), (expected.length, expected.event.is_some()));
        }
    }
}

/// Six unknowns without a closed form, followed in steps of the default length and in short ones.
#[test]
fn coarse_and_fine_steps_agree() {
    let m = DoubleButterfly::default();
    let guess = DoubleButterflyCoordinates {
        crank: 0.0,
        coupler: 0.558,
        upper: -0.325,
        rocker: 1.064,
        lower: 0.183,
        link: 0.354,
        strut: 1.2,
    };
    let Ok(start) = m.solve(&guess) else { panic!("no start") };
    let turn = |longest_step: f64, parts: u32| {
        let options = Options { longest_step, ..Options::default() };
        let mut path = Path::with(&m, &start.coordinates, Direction::Increasing, options).unwrap();
        (1..=12_u32)
            .map(|hour| {
                let part = |k: u32| TAU * (f64::from(hour - 1) + f64::from(k) / f64::from(parts)) / 12.0;
                (1..=parts).map(|k| path.advance_to(part(k)).unwrap()).last().unwrap()
            })
            .collect::<Vec<_>>()
    };
    for (coarse, fine) in turn(1.0, 1).into_iter().zip(turn(0.02, 7)) {
        let [coarse, fine] = [coarse, fine].map(|step| DoubleButterfly::unknowns(&step.position));
        assert_abs_diff_eq!((coarse - fine).largest(), 0.0, epsilon = 1e-13);
    }
}

/// Both cranks of a five-bar along a path of one parameter, there and through a change of both.
#[test]
fn along_a_path_of_two_inputs() {
    let inputs = |s: f64| -> [SVector<f64, 2>; 3] {
        [vector![s, 2.0 + 0.4 * s.sin()], vector![1.0, 0.4 * s.cos()], vector![0.0, -0.4 * s.sin()]]
    };
    let along = Along { mechanism: FiveBar::default(), inputs };
    let m = FiveBar::default();
    let branch = FiveBarBranch { theta2_theta3: Elbow::Left };
    let assemble = |s: f64| m.assemble(FiveBarInputs::from(inputs(s)[0]), branch).unwrap();
    let start = AlongCoordinates { q: assemble(0.3).coordinates(), parameter: 0.3 };
    let mut path = Path::new(&along, &start, Direction::Increasing).unwrap();
    for k in 1..=60 {
        let s = 0.3 + 0.2 * f64::from(k);
        let reached = path.advance_to(s).unwrap();
        let pose = m.pose_at(&along.position(&reached.position));
        let expected = assemble(s);
        assert_abs_diff_eq!(
            (m.jacobian_unknowns(&pose) - m.jacobian_unknowns(&expected)).largest(),
            0.0,
            epsilon = 1e-13
        );
        // dq/ds against the velocity for the inputs' rates.
        let rate = m.velocity(&pose, FiveBarInputs::from(inputs(s)[1])).unwrap();
        assert_abs_diff_eq!(reached.rates.rates.theta2 / reached.rates.parameter, rate.theta2, epsilon = 1e-12);
        assert_abs_diff_eq!(reached.rates.rates.theta3 / reached.rates.parameter, rate.theta3, epsilon = 1e-12);
    }
    // gamma of all unknowns: d2/ds2 of Psi, by differences of its first derivative.
    let at = |s: f64| AlongCoordinates { parameter: s, ..start };
    let of_q = FiveBarRates { theta1: 0.0, theta2: 0.3, theta3: -0.7, theta4: 0.0 };
    let rates = AlongRates { rates: of_q, parameter: 1.3 };
    let moved = |t: f64| {
        let q = FiveBarCoordinates { theta2: start.q.theta2 + 0.3 * t, theta3: start.q.theta3 - 0.7 * t, ..start.q };
        along.pose_at(&AlongCoordinates { q, ..at(0.3 + 1.3 * t) })
    };
    let slope = |t: f64| {
        let pose = moved(t);
        along.jacobian_unknowns(&pose) * Column::from([0.3, -0.7]) + along.jacobian_inputs(&pose) * Column::from([1.3])
    };
    let difference = (slope(1e-5) - slope(-1e-5)) / 2e-5;
    assert_abs_diff_eq!((difference - along.gamma(&moved(0.0), &rates)).largest(), 0.0, epsilon = 1e-9);
}

/// In single precision the path is the same, to rounding error.
#[test]
fn single_precision() {
    let wheels = CoupledWheels::<f64>::default().map(|length| length as f32);
    let start = CoupledWheelsCoordinates { theta: 0.4_f32, rod: 0.0, follower: 0.4 };
    let mut path = Path::new(&wheels, &start, Direction::Increasing).unwrap();
    for k in 1..=40 {
        let q = path.advance_to(0.4 + 0.37 * k as f32).unwrap().position;
        assert!((q.follower - q.theta).abs() < 2e-3 && q.rod.abs() < 2e-3, "{q:?}");
    }
    let m = FourBar::<f64>::default().map(|length| length as f32);
    let q = left(&FourBar::default(), 0.35);
    let guess = FourBarCoordinates { theta2: 0.35_f32, theta3: q.theta3 as f32, theta4: q.theta4 as f32 };
    let mut path = Path::new(&m, &guess, Direction::Increasing).unwrap();
    let q = path.advance_to(0.35 + TAU as f32).unwrap().position;
    assert!((q.theta3 - guess.theta3).abs() < 1e-5 && (q.theta4 - guess.theta4).abs() < 1e-5);
}

/// With a length among the unknowns, through both dead centres of the slider as its rate changes sign.
#[test]
fn strokes_of_a_slider() {
    let m = OffsetSliderCrank::default();
    let pose = m.branches(1.0).unwrap().next().unwrap().pose;
    let mut path = Path::new(&m, &pose.coordinates(), Direction::Increasing).unwrap();
    let mut ends = Vec::new();
    while path.position().theta2 < 1.0 + TAU {
        let step = path.advance_watching(|_, rates| rates.d).unwrap();
        if step.event == Some(Event::Zero) {
            assert_abs_diff_eq!((step.position.theta2 - step.position.theta3).sin(), 0.0, epsilon = 1e-14);
            ends.push(step.position.d);
        }
    }
    assert_eq!(ends.len(), 2);
    assert!((ends[0] - ends[1]).abs() > 1.0);
    assert!(matches!(path.advance_to(f64::NAN), Err(PathError::Position(PositionError::NotFinite { .. }))));
    assert!(path.position().theta2 < 2.0 * PI + 2.0);
}
