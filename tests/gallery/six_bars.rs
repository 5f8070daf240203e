//! The six-bars of Watt and of Stephenson, and an eight-bar that cannot be taken apart.

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
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (bp, dq) = (m.px.hypot(m.py), m.qx.hypot(m.qy));
    let (cp, cq) = ((m.b - m.px).hypot(m.py), (m.c - m.qx).hypot(m.qy));
    rigid!(
        course,
        a - d = m.d,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        b - p = bp,
        c - p = cp,
        d - q = dq,
        c - q = cq,
        p - r = m.e,
        r - q = m.f
    );
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
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let cp = (m.c * m.c + m.e * m.e - 2.0 * m.c * m.e * m.delta.cos()).sqrt();
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        d - p = m.e,
        c - p = cp,
        p - q = m.f,
        q - f = m.g
    );
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
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (ap, bp) = (m.px.hypot(m.py), (m.a - m.px).hypot(m.py));
    let (dq, cq) = (m.qx.hypot(m.qy), (m.c - m.qx).hypot(m.qy));
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        a - p = ap,
        b - p = bp,
        d - q = dq,
        c - q = cq,
        p - r = m.e,
        r - q = m.f
    );
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
    let course = turn(&m, start, |q| &mut q.theta);
    from_the_last!(m, course, theta);
    let (ab, ce, de) = ((m.a - m.bx).hypot(m.by), m.ex.hypot(m.ey), (m.cd - m.ex).hypot(m.ey));
    rigid!(
        course,
        o - a = m.a,
        a - b = ab,
        a - c = m.p,
        b - d = m.q,
        c - d = m.cd,
        c - e = ce,
        d - e = de,
        e - g = m.r
    );
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
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (bp, cp) = (m.px.hypot(m.py), (m.b - m.px).hypot(m.py));
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        b - p = bp,
        c - p = cp,
        p - q = m.e,
        q - f = m.f
    );
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
    let course = turn(&m, start, |q| &mut q.crank);
    from_the_last!(m, course, crank);
    let (ad, cd) = (m.dx.hypot(m.dy), (m.ac - m.dx).hypot(m.dy));
    let (eg, fg) = (m.gx.hypot(m.gy), (m.ef - m.gx).hypot(m.gy));
    let (bj, fj) = (m.jx.hypot(m.jy), (m.bf - m.jx).hypot(m.jy));
    let (di, hi) = (m.ix.hypot(m.iy), (m.dh - m.ix).hypot(m.iy));
    rigid!(
        course,
        a - b = m.ab,
        a - c = m.ac,
        a - d = ad,
        c - d = cd,
        c - e = m.ce,
        e - f = m.ef,
        e - g = eg,
        f - g = fg,
        b - f = m.bf,
        b - j = bj,
        f - j = fj,
        d - h = m.dh,
        d - i = di,
        h - i = hi,
        g - h = m.gh,
        i - j = m.ij
    );
}
