//! Sliders in the frame: pistons, rams and trammels.

use approx::assert_abs_diff_eq;
use std::f64::consts::FRAC_PI_2;

use super::course::{degrees, turn};
use super::exactness::exact;

use linkage_gallery::elliptic_trammel::*;
use linkage_gallery::offset_slider_crank::*;
use linkage_gallery::scotch_yoke::*;
use linkage_gallery::v_twin::*;

#[test]
fn offset_slider_crank() {
    let m = OffsetSliderCrank::default();
    let start = OffsetSliderCrankCoordinates { theta2: degrees(60.0), theta3: degrees(153.0), d: 127.0 };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(OffsetSliderCrank::points, |p| [(p.o, p.a, m.a), (p.a, p.b, m.b)]);
    // Crank and rod in line at both ends of the stroke.
    let [least, largest] = course.range(|q| q.d);
    exact(least, ((m.b - m.a).powi(2) - m.c * m.c).sqrt(), m.a + m.b);
    exact(largest, ((m.b + m.a).powi(2) - m.c * m.c).sqrt(), m.a + m.b);
}

/// x = r cos(phi), to an ulp of the radius.
#[test]
fn scotch_yoke_is_a_cosine() {
    let m = ScotchYoke::default();
    let course = turn(&m, ScotchYokeCoordinates { phi: 0.0, x: 0.5 });
    course.closed_form();
    for q in &course.positions {
        assert_abs_diff_eq!(q.x, m.r * q.phi.cos(), epsilon = f64::EPSILON * m.r);
        let motion = m.motion(q, 2.0, 0.0).unwrap();
        exact(motion.rates.x, -2.0 * m.r * q.phi.sin(), m.r);
        exact(motion.accelerations.x, -4.0 * q.x, m.r);
    }
}

#[test]
fn elliptic_trammel_draws_an_ellipse() {
    let m = EllipticTrammel::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let course = turn(&m, EllipticTrammelCoordinates { theta: 0.0, x: -2.0, y: 0.0 });
    course.closed_form();
    course
        .rigid(EllipticTrammel::points, |p| [(p.a, p.b, m.rod), (p.a, p.pen, m.reach), (p.b, p.pen, m.reach - m.rod)]);
    let pen = |q: &_| points(q).pen;
    for q in &course.positions {
        let at = pen(q);
        exact((at.x / (m.reach - m.rod)).powi(2) + (at.y / m.reach).powi(2), 1.0, 1.0);
    }
}

/// The rear piston does what the front one did, the angle of the vee later.
#[test]
fn v_twin_runs_in_phase() {
    let m = VTwin::default();
    let start = VTwinCoordinates {
        theta: FRAC_PI_2,
        phi_front: degrees(61.4),
        s_front: 225.0,
        phi_rear: degrees(118.6),
        s_rear: 225.0,
    };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(VTwin::points, |p| [(p.o, p.pin, m.crank), (p.pin, p.front, m.rod), (p.pin, p.rear, m.rod)]);
    let later = m.vee.to_degrees().round() as usize;
    for (front, rear) in course.positions.iter().zip(&course.positions[later..]) {
        exact(rear.s_rear, front.s_front, m.crank + m.rod);
    }
    // Top dead centre with crank and rod in line.
    let [bottom, top] = course.range(|q| q.s_front);
    exact(top, m.rod + m.crank, m.rod + m.crank);
    exact(bottom, m.rod - m.crank, m.rod + m.crank);
}
