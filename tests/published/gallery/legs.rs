//! Legs that walk.

use approx::assert_abs_diff_eq;
use std::f64::consts::{PI, TAU};

use super::course::{degrees, turn};
use super::exactness::exact;

use linkage_gallery::jansen::*;
use linkage_gallery::klann::*;

fn jansen_start() -> JansenCoordinates<f64> {
    JansenCoordinates {
        crank: 0.0,
        angle_b: degrees(70.3),
        angle_j: degrees(141.3),
        angle_d: degrees(156.6),
        angle_e: degrees(-155.4),
        angle_c: degrees(-73.7),
        angle_k: degrees(-132.7),
        angle_f: degrees(-67.0),
        angle_g: degrees(151.9),
        angle_h: degrees(-75.7),
        angle_i: degrees(-109.3),
    }
}

/// Foot positions, ranges and the share of the turn on the ground, from circles that intersect, in 40-digit
/// arithmetic.
#[test]
fn jansen_walks() {
    let m = Jansen::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let course = turn(&m, jansen_start());
    course.closed_form();
    course.rigid(Jansen::points, |p| {
        [
            (p.o, p.pin, m.m),
            (p.pin, p.upper, m.j),
            (p.pivot, p.upper, m.b),
            (p.upper, p.back, m.e),
            (p.pivot, p.back, m.d),
            (p.pin, p.knee, m.k),
            (p.pivot, p.knee, m.c),
            (p.back, p.ankle, m.f),
            (p.knee, p.ankle, m.g),
            (p.ankle, p.foot, m.h),
            (p.knee, p.foot, m.i),
        ]
    });
    let foot = |q: &_| points(q).foot;
    let size = [m.a, m.b, m.c, m.d, m.e, m.f, m.g, m.h, m.i, m.j, m.k, m.l, m.m].iter().sum();
    for (angle, [x, y]) in [
        (0.0, [-43.160_110_524_104_72, -91.756_932_926_123_22]),
        (45.0, [-24.398_517_179_300_76, -91.790_903_870_552_77]),
    ] {
        let found = foot(&course.at(degrees(angle)));
        exact(found.x, x, size);
        exact(found.y, y, size);
    }
    let [left, right] = course.range(|q| points(q).foot.x);
    exact(right - left, 67.908_421_691_508_24, size);
    let [bottom, top] = course.range(|q| points(q).foot.y);
    exact(top - bottom, 22.457_173_584_316_21, size);
    // The foot is within 1 of the lowest point from one crossing, through 0, to the other.
    let [lifts, lands] = course.roots(|q| foot(q).y - (bottom + 1.0))[..] else { panic!("two crossings") };
    assert_abs_diff_eq!(lifts, degrees(81.187_870_798_704_8), epsilon = 1e-12);
    assert_abs_diff_eq!(lands, degrees(286.012_419_030_292), epsilon = 1e-12);
    assert_abs_diff_eq!(1.0 - (lands - lifts) / TAU, 0.431_042_921_579, epsilon = 1e-12);
}

/// The reference pose of the patent's table 1, to its digits: foot (0, 0), knee (.232, .866), hip (.866, 1.5).
/// The step by intersecting circles in 40-digit arithmetic; Klann's own page gives its height as 52.3 % of the
/// stride.
#[test]
fn klann_walks() {
    let m = Klann::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = KlannCoordinates {
        theta: PI,
        arm: PI,
        lower_angle: degrees(146.7),
        leg: degrees(45.0),
        upper_angle: degrees(165.0),
    };
    let course = turn(&m, start);
    course.closed_form();
    // The third side of a triangle, by the law of cosines.
    let third = |a: f64, b: f64, angle: f64| (a * a + b * b - 2.0 * a * b * angle.cos()).sqrt();
    course.rigid(Klann::points, |p| {
        [
            (p.o, p.pin, m.crank),
            (p.pin, p.elbow, m.pin_elbow),
            (p.elbow, p.knee, m.elbow_knee),
            (p.pin, p.knee, third(m.pin_elbow, m.elbow_knee, PI + m.elbow_bend)),
            (p.lower, p.elbow, m.lower),
            (p.knee, p.hip, m.knee_hip),
            (p.knee, p.foot, m.knee_foot),
            (p.foot, p.hip, third(m.knee_hip, m.knee_foot, m.knee_bend)),
            (p.upper, p.hip, m.upper),
        ]
    });
    assert_abs_diff_eq!(third(m.pin_elbow, m.elbow_knee, PI + m.elbow_bend), 1.1051, epsilon = 5e-5);
    assert_abs_diff_eq!(third(m.knee_hip, m.knee_foot, m.knee_bend), 1.732, epsilon = 5e-4);
    let first = points(&course.positions[0]);
    for (found, expected) in [(first.foot, [0.0, 0.0]), (first.knee, [0.232, 0.866]), (first.hip, [0.866, 1.5])] {
        assert_abs_diff_eq!(found.x, expected[0], epsilon = 5e-4);
        assert_abs_diff_eq!(found.y, expected[1], epsilon = 5e-4);
    }
    let size = m.crank + m.lower + m.upper + m.pin_elbow + m.elbow_knee + m.knee_hip + m.knee_foot;
    let [left, right] = course.range(|q| points(q).foot.x);
    let [bottom, top] = course.range(|q| points(q).foot.y);
    exact(right - left, 1.008_627_899_360_890_7, size);
    exact(top - bottom, 0.527_549_050_784_531_3, size);
    assert_abs_diff_eq!((top - bottom) / (right - left), 0.523, epsilon = 5e-4);
}
