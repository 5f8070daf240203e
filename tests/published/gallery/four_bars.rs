//! One loop of four links, and two of them in a row.

use approx::assert_abs_diff_eq;
use std::f64::consts::{FRAC_PI_2, PI};

use super::course::{degrees, turn};
use super::exactness::exact;

use linkage_gallery::four_bar::*;
use linkage_gallery::wiper::*;

#[test]
fn four_bar_on_both_branches() {
    let m = FourBar::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    for (theta3, theta4, side) in [(70.0, -50.0, 1.0), (-83.0, 38.0, -1.0)] {
        let start = FourBarCoordinates { theta2: degrees(20.0), theta3: degrees(theta3), theta4: degrees(theta4) };
        let course = turn(&m, start);
        course.closed_form();
        course.rigid(FourBar::points, |p| [(p.b, p.c, m.l3), (p.b, p.g3, m.l3 / 2.0), (p.c, p.g4, m.l4 / 2.0)]);
        // On one branch C is always above the line from B to D, on the other below it.
        assert!(course.positions.iter().all(|q| side * m.outputs(&m.pose_at(q)).unwrap().mu.sin() > 0.0));
        for q in &course.positions {
            let points = points(q);
            exact((points.c - nalgebra::point![m.l1, 0.0]).norm(), m.l4, m.l1 + m.l2 + m.l3 + m.l4);
        }
    }
}

#[test]
fn wiper_sweeps() {
    let m = Wiper::default();
    let start = WiperCoordinates {
        theta: FRAC_PI_2,
        phi: degrees(3.8),
        first: degrees(93.8),
        rod: degrees(10.0),
        second: degrees(93.8),
    };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(Wiper::points, |p| {
        [
            (p.motor, p.first, m.base),
            (p.motor, p.pin, m.crank),
            (p.pin, p.first_pin, m.link),
            (p.first, p.first_pin, m.arm),
            (p.first, p.second, m.span),
            (p.first_pin, p.second_pin, m.span),
            (p.second, p.second_pin, m.arm),
            (p.first, p.first_tip, m.blade),
            (p.second, p.second_tip, m.blade),
        ]
    });
    let sweep = 2.0 * (m.crank / m.arm).asin();
    for of in [|q: &WiperCoordinates| q.first, |q: &WiperCoordinates| q.second] {
        let [least, largest] = course.range(of);
        assert_abs_diff_eq!(largest - least, sweep, epsilon = 1e-13);
    }
    // Both strokes take half a turn.
    let [first, second] = course.roots(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().first)[..] else {
        panic!("two dead centres")
    };
    assert_abs_diff_eq!(second - first, PI, epsilon = 1e-13);
    for q in &course.positions {
        assert_abs_diff_eq!(q.rod, m.tilt, epsilon = 1e-14);
    }
}
