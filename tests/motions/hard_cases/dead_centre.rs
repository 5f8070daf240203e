//! A crank driven by its slider to the dead centre, and through it.
//!
//! Known to fail: the crank angle by the law of cosines, acos, which loses half its digits there, and Newton's method
//! at a given stroke, which takes 199 steps at delta = 1e-13 and may come out on either side of the dead centre.

use std::f64::consts::PI;

use linkage::continuation::{Direction, Event, Path};
use linkage::{PathError, linkage};

use linkage_gallery::four_bar::*;
use linkage_gallery::slider_crank::*;

linkage! {
    /// A lever that lifts its end to a given height.
    #[derive(Debug, Clone)]
    mechanism Lift {
        param l = 100;
        input h;
        unknown a;
        equation l * sin(a) = h;
    }
}

const R: f64 = 0.15;
const L: f64 = 0.3;

fn engine() -> Engine {
    Engine::new(R, L)
}

fn start() -> SliderCrankCoordinates {
    let phi1: f64 = 1.0;
    let phi2 = -(R / L * phi1.sin()).asin();
    SliderCrankCoordinates { z3: R * phi1.cos() + L * phi2.cos(), phi1, phi2 }
}

/// The crank angle from the sides of the triangle, by W. Kahan's formula.
fn crank_angle(z3: f64) -> f64 {
    let shortfall = (L - z3) + R;
    if shortfall <= 0.0 {
        return 0.0;
    }
    2.0 * (shortfall * (z3 + (L - R))).sqrt().atan2(((z3 - L) + R).sqrt() * (z3 + (L + R)).sqrt())
}

#[test]
fn to_the_last_digit() {
    let m = engine();
    for exponent in 1..=17 {
        let delta = if exponent == 17 { 0.0 } else { 10_f64.powi(-exponent) };
        let z3 = R + L - delta;
        let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
        let q = path.advance_to(z3).unwrap_or_else(|error| panic!("{delta:e}: {error}")).position;
        let expected = crank_angle(z3);
        println!("delta {delta:e}: crank at {:e}, expected {expected:e}", q.phi1);
        assert_eq!(q.z3, z3);
        // The stroke is 0.45 - 0.225 phi1^2 + ...: four ulps of terms whose sum is 0.9 move the crank by this much.
        let error = 16.0 * 2.0 * f64::EPSILON / expected.max(f64::EPSILON.sqrt());
        assert!((q.phi1 - expected).abs() <= error, "{delta:e}: {} is not {expected}", q.phi1);
    }
}

#[test]
fn the_crank_keeps_its_direction() {
    let m = engine();
    for delta in [0.0, 1e-16] {
        let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
        path.advance_to(R + L - delta).unwrap();
        // On the way out the crank goes on through the dead centre, and does not return the way it came.
        let q = path.advance_to(0.4).unwrap().position;
        assert!((q.phi1 + crank_angle(0.4)).abs() < 1e-14, "{delta:e}: {q:?}");
    }
    // Before the dead centre the same call goes back.
    let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
    path.advance_to(R + L - 1e-6).unwrap();
    let q = path.advance_to(0.4).unwrap().position;
    assert!((q.phi1 - crank_angle(0.4)).abs() < 1e-14);
}

/// Five turns of the crank, driven by the slider, with one derivation.
#[test]
fn round_and_round() {
    let m = engine();
    let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
    let mut last = path.position().phi1;
    let mut dead_points = Vec::new();
    while path.position().phi1 > -31.0 {
        let step = path.advance().unwrap();
        assert!(step.position.phi1 < last);
        last = step.position.phi1;
        if let Some(Event::DeadPoint { group }) = step.event {
            assert_eq!(group, "phi1, phi2");
            let stroke = if dead_points.len() % 2 == 0 { R + L } else { L - R };
            assert!((step.position.z3 - stroke).abs() < 1e-15);
            assert!((step.position.phi1 + std::f64::consts::PI * dead_points.len() as f64).abs() < 1e-14);
            assert!(step.rates.z3.abs() < 1e-14);
            dead_points.push(step.position.phi1);
        } else {
            assert_eq!(step.event, None);
        }
    }
    assert_eq!(dead_points.len(), 10);
}

#[test]
fn beyond_reach() {
    let m = engine();
    let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
    let Err(PathError::DeadPoint { mechanism, group, gap }) = path.advance_to(0.46) else { panic!("it cannot reach") };
    assert_eq!((mechanism, group), ("Engine", "phi1, phi2"));
    // In the unit of the stroke, to the accuracy of the dead centre.
    assert!((gap - (0.46 - (R + L))).abs() < 1e-15);
    assert!(path.position().phi1.abs() < 1e-14);
}

/// The distance to an input that is a length is one in its unit, in whatever unit the lengths are.
#[test]
fn gaps_are_in_the_unit_of_the_input() {
    for scale in [1.0, 2_f64.powi(300), 2_f64.powi(-300)] {
        let m = Lift::new(100.0 * scale);
        let mut path = Path::new(&m, &LiftCoordinates { h: 0.0, a: 0.0 }, Direction::Increasing).unwrap();
        let error = path.advance_to(150.0 * scale).unwrap_err();
        let PathError::DeadPoint { gap, .. } = error else { panic!("{error:?}") };
        assert!((gap / scale - 50.0).abs() < 1e-12, "{gap}");
        if scale == 1.0 {
            assert_eq!(error.to_string(), "Lift locks 50.0 before this input: group a is at a dead point");
        }
        let m = Engine::new(100.0 * scale, 300.0 * scale);
        let angle = -(100.0_f64 / 300.0).asin();
        let start = SliderCrankCoordinates { phi1: PI / 2.0, phi2: angle, z3: 300.0 * angle.cos() * scale };
        let error = Path::new(&m, &start, Direction::Increasing).unwrap().advance_to(450.0 * scale).unwrap_err();
        let PathError::DeadPoint { gap, .. } = error else { panic!("{error:?}") };
        assert!((gap / scale - 50.0).abs() < 1e-11, "{gap}");
    }
    // An angle is in radians: the crank of a four-bar locks where the coupler and the rocker are in line.
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let limit = ((80.0_f64.powi(2) + 50.0_f64.powi(2) - 100.0_f64.powi(2)) / (2.0 * 80.0 * 50.0)).acos();
    let start = m.branches(1.0).unwrap().next().unwrap().pose.coordinates();
    let error = Path::new(&m, &start, Direction::Increasing).unwrap().advance_to(limit + 0.25).unwrap_err();
    assert_eq!(error.to_string(), "FourBar locks 0.250 before this input: group theta3, theta4 is at a dead point");
}
