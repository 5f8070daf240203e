//! The six-bars of Watt and of Stephenson, and an eight-bar whose unknowns are one group.

use std::f64::consts::FRAC_PI_2;

use super::course::{degrees, turn};

use linkage_gallery::double_butterfly::*;
use linkage_gallery::stephenson_i::*;
use linkage_gallery::stephenson_ii::*;
use linkage_gallery::stephenson_iii::*;
use linkage_gallery::watt_i::*;
use linkage_gallery::watt_ii::*;

#[test]
fn watt_i() {
    let m = WattI::default();
    let start = WattICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(79.0),
        theta6: degrees(132.3),
    };
    let course = turn(&m, start);
    course.closed_form();
    let (bp, dq) = (m.px.hypot(m.py), m.qx.hypot(m.qy));
    let (cp, cq) = ((m.b - m.px).hypot(m.py), (m.c - m.qx).hypot(m.qy));
    course.rigid(WattI::points, |p| {
        [
            (p.a, p.d, m.d),
            (p.a, p.b, m.a),
            (p.b, p.c, m.b),
            (p.c, p.d, m.c),
            (p.b, p.p, bp),
            (p.c, p.p, cp),
            (p.d, p.q, dq),
            (p.c, p.q, cq),
            (p.p, p.r, m.e),
            (p.r, p.q, m.f),
        ]
    });
}

#[test]
fn watt_ii() {
    let m = WattII::default();
    let start = WattIICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(0.5),
        theta6: degrees(93.3),
    };
    let course = turn(&m, start);
    course.closed_form();
    let cp = (m.c * m.c + m.e * m.e - 2.0 * m.c * m.e * m.delta.cos()).sqrt();
    course.rigid(WattII::points, |p| {
        [
            (p.a, p.b, m.a),
            (p.b, p.c, m.b),
            (p.c, p.d, m.c),
            (p.a, p.d, m.d),
            (p.d, p.p, m.e),
            (p.c, p.p, cp),
            (p.p, p.q, m.f),
            (p.q, p.f, m.g),
        ]
    });
}

#[test]
fn stephenson_i() {
    let m = StephensonI::default();
    let start = StephensonICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(60.0),
        theta6: degrees(151.0),
    };
    let course = turn(&m, start);
    course.closed_form();
    let (ap, bp) = (m.px.hypot(m.py), (m.a - m.px).hypot(m.py));
    let (dq, cq) = (m.qx.hypot(m.qy), (m.c - m.qx).hypot(m.qy));
    course.rigid(StephensonI::points, |p| {
        [
            (p.a, p.b, m.a),
            (p.b, p.c, m.b),
            (p.c, p.d, m.c),
            (p.a, p.d, m.d),
            (p.a, p.p, ap),
            (p.b, p.p, bp),
            (p.d, p.q, dq),
            (p.c, p.q, cq),
            (p.p, p.r, m.e),
            (p.r, p.q, m.f),
        ]
    });
}

#[test]
fn stephenson_ii() {
    let m = StephensonII::default();
    let start = StephensonIICoordinates {
        theta: 0.0,
        alpha: degrees(30.0),
        beta: degrees(21.0),
        tau: degrees(-90.0),
        rho: degrees(54.0),
    };
    let course = turn(&m, start);
    course.assembles_from_the_last(|guess, pose| m.assemble_near(guess, m.branch_of(pose)));
    let (ab, ce, de) = ((m.a - m.bx).hypot(m.by), m.ex.hypot(m.ey), (m.cd - m.ex).hypot(m.ey));
    course.rigid(StephensonII::points, |p| {
        [
            (p.o, p.a, m.a),
            (p.a, p.b, ab),
            (p.a, p.c, m.p),
            (p.b, p.d, m.q),
            (p.c, p.d, m.cd),
            (p.c, p.e, ce),
            (p.d, p.e, de),
            (p.e, p.g, m.r),
        ]
    });
}

#[test]
fn stephenson_iii() {
    let m = StephensonIII::default();
    let start = StephensonIIICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(-0.6),
        theta6: degrees(99.4),
    };
    let course = turn(&m, start);
    course.closed_form();
    let (bp, cp) = (m.px.hypot(m.py), (m.b - m.px).hypot(m.py));
    course.rigid(StephensonIII::points, |p| {
        [
            (p.a, p.b, m.a),
            (p.b, p.c, m.b),
            (p.c, p.d, m.c),
            (p.a, p.d, m.d),
            (p.b, p.p, bp),
            (p.c, p.p, cp),
            (p.p, p.q, m.e),
            (p.q, p.f, m.f),
        ]
    });
}

#[test]
fn double_butterfly() {
    let m = DoubleButterfly::default();
    let start = DoubleButterflyCoordinates {
        crank: 1.036,
        coupler: 1.0,
        upper: -0.595,
        rocker: 1.408,
        lower: 0.508,
        link: -0.004,
        strut: 1.591,
    };
    let course = turn(&m, start);
    course.assembles_from_the_last(|guess, pose| m.assemble_near(guess, m.branch_of(pose)));
    let (ad, cd) = (m.dx.hypot(m.dy), (m.ac - m.dx).hypot(m.dy));
    let (eg, fg) = (m.gx.hypot(m.gy), (m.ef - m.gx).hypot(m.gy));
    let (bj, fj) = (m.jx.hypot(m.jy), (m.bf - m.jx).hypot(m.jy));
    let (di, hi) = (m.ix.hypot(m.iy), (m.dh - m.ix).hypot(m.iy));
    course.rigid(DoubleButterfly::points, |p| {
        [
            (p.a, p.b, m.ab),
            (p.a, p.c, m.ac),
            (p.a, p.d, ad),
            (p.c, p.d, cd),
            (p.c, p.e, m.ce),
            (p.e, p.f, m.ef),
            (p.e, p.g, eg),
            (p.f, p.g, fg),
            (p.b, p.f, m.bf),
            (p.b, p.j, bj),
            (p.f, p.j, fj),
            (p.d, p.h, m.dh),
            (p.d, p.i, di),
            (p.h, p.i, hi),
            (p.g, p.h, m.gh),
            (p.i, p.j, m.ij),
        ]
    });
}
