//! Lines that are straight, and nearly so.

use approx::assert_abs_diff_eq;
use std::f64::consts::{FRAC_PI_2, PI};

use super::course::{STEPS, degrees, follow, turn};
use super::exactness::exact;

use linkage_gallery::cardan::*;
use linkage_gallery::chebyshev::*;
use linkage_gallery::hart::*;
use linkage_gallery::hoecken::*;
use linkage_gallery::peaucellier::*;
use linkage_gallery::roberts::*;
use linkage_gallery::watt_line::*;

/// The rise of Hoecken's and Chebyshev's lines, in cranks of Hoecken: from intersecting circles in 40-digit arithmetic.
const RISE: f64 = 0.009_753_733_086_360_006;

#[test]
fn hoecken_is_nearly_straight() {
    let m = Hoecken::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = HoeckenCoordinates { theta2: FRAC_PI_2, theta3: degrees(20.0), theta4: degrees(130.0) };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(Hoecken::points, |p| {
        [
            (p.a, p.d, m.ground),
            (p.a, p.b, m.crank),
            (p.b, p.c, m.coupler),
            (p.c, p.d, m.rocker),
            (p.b, p.p, m.reach),
            (p.c, p.p, m.reach - m.coupler),
        ]
    });
    let size = m.crank + m.ground + m.coupler + m.rocker + m.reach;
    let half = follow(&m, course.positions[0], PI);
    let [low, high] = half.range(|q| points(q).p.y);
    exact(low, 4.0, size);
    exact(high - low, RISE, size);
    let x = |q| points(q).p.x;
    exact(x(&half.positions[0]) - x(&half.positions[STEPS as usize]), 4.0, size);
}

/// Between the middle of the ground link and its ends the line rises and comes back; it does so exactly as
/// Hoecken's, which is the same curve (the theorem of Roberts and Chebyshev on cognates).
#[test]
fn chebyshev_is_nearly_straight() {
    let m = ChebyshevCoupler::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = ChebyshevCoordinates { theta2: 4.0_f64.atan2(3.0), theta3: PI, theta4: 4.0_f64.atan2(-3.0) };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(ChebyshevCoupler::points, |p| {
        [
            (p.a, p.d, m.ground),
            (p.a, p.b, m.rocker),
            (p.c, p.d, m.rocker),
            (p.b, p.p, m.coupler / 2.0),
            (p.c, p.p, m.coupler / 2.0),
        ]
    });
    let size = m.ground + 2.0 * m.rocker + m.coupler;
    let p = |q: &_| points(q).p;
    for (span, x) in [(FRAC_PI_2, 0.0), (-FRAC_PI_2, 4.0)] {
        let course = follow(&m, start, span);
        course.closed_form();
        let end = p(&course.positions[STEPS as usize]);
        exact(end.x, x, size);
        exact(end.y, 4.0, size);
        let [low, high] = course.range(|q| points(q).p.y);
        exact(low, 4.0, size);
        exact(high - low, RISE, size);
        // A quarter of the ground link from the middle.
        let [quarter] = course.roots(|q| p(q).x - (x + 2.0) / 2.0)[..] else { panic!("one crossing") };
        exact(p(&course.at(quarter)).y, 4.009_047_910_620_066, size);
    }
    // The rocker drives the same stretch: from y = 4 to y = 4.
    let m = ChebyshevRocker::default();
    let course = follow(&m, start, degrees(36.0) - start.theta2 + degrees(1.0));
    course.closed_form();
    exact(course.range(|q| points(q).p.y)[1] - 4.0, RISE, size);
}

/// The apex passes through both pivots and the middle between them; the largest deviation from intersecting
/// circles in 40-digit arithmetic.
#[test]
fn roberts_is_nearly_straight() {
    let m = Roberts::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    // Where the apex is on the first pivot, C hangs above the middle, and B one apex angle further.
    let end = (1.0 / m.side).acos();
    let first = end + 2.0 * (m.coupler / 2.0 / m.side).asin();
    let start = RobertsCoordinates { theta2: first, theta3: degrees(-27.6), theta4: PI - end };
    let course = follow(&m, start, end - first);
    course.closed_form();
    course.rigid(Roberts::points, |p| {
        [
            (p.a, p.d, m.ground),
            (p.a, p.b, m.side),
            (p.b, p.c, m.coupler),
            (p.c, p.d, m.side),
            (p.b, p.p, m.side),
            (p.c, p.p, m.side),
        ]
    });
    let size = m.ground + 4.0 * m.side + m.coupler;
    let p = |q: &_| points(q).p;
    for (theta2, x) in [(first, 0.0), (m.height.atan2(m.coupler / 2.0), 1.0), (end, 2.0)] {
        let found = p(&course.at(theta2));
        exact(found.x, x, size);
        exact(found.y, 0.0, size);
    }
    let [low, high] = course.range(|q| points(q).p.y);
    exact(low, -0.009_943_170_941_156_022, size);
    exact(high, 0.0, size);
}

/// x = y^5 / (8 arm^3 half_link) near the middle; the ends of the stroke from intersecting circles in 40-digit
/// arithmetic.
#[test]
fn watt_line_touches_fivefold() {
    let m = WattLine::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = WattLineCoordinates { theta: degrees(-20.0), phi: -FRAC_PI_2, psi: degrees(-160.0) };
    let course = follow(&m, start, degrees(40.0));
    course.closed_form();
    course.rigid(WattLine::points, |p| {
        [
            (p.left, p.b, m.arm),
            (p.b, p.c, 2.0 * m.half_link),
            (p.c, p.right, m.arm),
            (p.b, p.p, m.half_link),
            (p.c, p.p, m.half_link),
        ]
    });
    let size = 4.0 * m.arm + 4.0 * m.half_link;
    let p = |q: &_| points(q).p;
    for (theta, [x, y]) in [
        (20.0, [0.020_015_353_302_028_83, 1.763_208_879_656_721]),
        (-20.0, [-0.014_855_361_898_719_738, -1.668_126_654_672_266_6]),
    ] {
        let found = p(&course.at(degrees(theta)));
        exact(found.x, x, size);
        exact(found.y, y, size);
    }
    for theta in [0.02, 0.04, 0.08] {
        let found = p(&course.at(theta));
        let ratio = found.x * 8.0 * m.arm.powi(3) * m.half_link / found.y.powi(5);
        // The next term of the series is theta^2.
        assert_abs_diff_eq!((ratio - 1.0) / (theta * theta), 1.0, epsilon = 0.02);
    }
}

#[test]
fn peaucellier_is_straight() {
    let m = Peaucellier::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let (arm, side) = (degrees(34.9), degrees(72.5));
    let start = PeaucellierCoordinates {
        theta: 0.0,
        upper: arm,
        upper_side: side,
        lower: -arm,
        lower_side: -side,
        upper_tip: -side,
        lower_tip: side,
    };
    let size = 2.0 * m.crank + 2.0 * m.long + 4.0 * m.short;
    let line = (m.long * m.long - m.short * m.short) / (2.0 * m.crank);
    for span in [degrees(90.0), degrees(-90.0)] {
        let course = follow(&m, start, span);
        course.closed_form();
        course.rigid(Peaucellier::points, |p| {
            [
                (p.o, p.centre, m.crank),
                (p.centre, p.p, m.crank),
                (p.o, p.upper, m.long),
                (p.o, p.lower, m.long),
                (p.p, p.upper, m.short),
                (p.p, p.lower, m.short),
                (p.q, p.upper, m.short),
                (p.q, p.lower, m.short),
            ]
        });
        for q in &course.positions {
            let motion = m.motion(q, 1.0, 0.0).unwrap();
            let tip = motion.points.q;
            exact(tip.position.x, line, size);
            let rates = nalgebra::SVector::from(motion.rates).amax();
            let accelerations = nalgebra::SVector::from(motion.accelerations).amax();
            exact(tip.velocity.x, 0.0, size * rates);
            exact(tip.acceleration.x, 0.0, size * (rates * rates + accelerations));
            // P and Q are inverse.
            exact(motion.outputs.product.value, m.long * m.long - m.short * m.short, size);
        }
        assert!(course.range(|q| points(q).q.y).into_iter().any(|y| y.abs() > 4.9));
    }
}

#[test]
fn hart_is_straight() {
    let m = Hart::default();
    let (long, short) = (degrees(145.1), degrees(107.5));
    let start = HartCoordinates { theta: 0.0, alpha: -long, beta: -short, gamma: short, delta: long };
    let size = 2.0 * (m.crank + m.long + m.short);
    let product = -m.part * (1.0 - m.part) * (m.long * m.long - m.short * m.short);
    for span in [degrees(90.0), degrees(-90.0)] {
        let course = follow(&m, start, span);
        course.closed_form();
        course.rigid(Hart::points, |p| {
            [
                (p.o, p.centre, m.crank),
                (p.centre, p.p, m.crank),
                (p.a, p.b, m.long),
                (p.c, p.d, m.long),
                (p.b, p.c, m.short),
                (p.d, p.a, m.short),
                (p.a, p.o, m.part * m.long),
                (p.a, p.p, m.part * m.short),
                (p.c, p.q, m.part * m.short),
            ]
        });
        for q in &course.positions {
            let motion = m.motion(q, 1.0, 0.0).unwrap();
            let rates = nalgebra::SVector::from(motion.rates).amax();
            let accelerations = nalgebra::SVector::from(motion.accelerations).amax();
            let tip = motion.points.q;
            exact(motion.outputs.product.value, product, size);
            exact(tip.position.x, product / (2.0 * m.crank), size);
            exact(tip.velocity.x, 0.0, size * rates);
            exact(tip.acceleration.x, 0.0, size * (rates * rates + accelerations));
        }
    }
}

#[test]
fn cardan_is_straight() {
    let m = Cardan::default();
    let course = turn(&m, CardanCoordinates { carrier: 0.0, roll: 0.1 });
    course.closed_form();
    course.rigid(Cardan::points, |p| {
        [(p.o, p.centre, m.ring - m.planet), (p.centre, p.rim, m.planet), (p.centre, p.pen, m.pen)]
    });
    for q in &course.positions {
        let motion = m.motion(q, 1.0, 0.0).unwrap();
        let rim = motion.points.rim;
        assert_eq!((rim.position.y, rim.velocity.y, rim.acceleration.y), (0.0, 0.0, 0.0));
        exact(rim.position.x, m.ring * q.carrier.cos(), m.ring);
        let pen = motion.points.pen.position;
        let [long, short] = [m.planet + m.pen, m.planet - m.pen];
        exact((pen.x / long).powi(2) + (pen.y / short).powi(2), 1.0, 1.0);
    }
}
