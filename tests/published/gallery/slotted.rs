//! Slots in links that turn: slotted cranks and levers, quick returns, and the wheel of Geneva.

use approx::assert_abs_diff_eq;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::course::{STEPS, degrees, follow, turn};
use super::exactness::exact;

use linkage_gallery::crank_shaper::*;
use linkage_gallery::geneva::*;
use linkage_gallery::inverted_slider_crank::*;
use linkage_gallery::whitworth::*;

#[test]
fn inverted_slider_crank() {
    let m = InvertedSliderCrank::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = InvertedSliderCrankCoordinates { theta2: 0.0, theta4: degrees(109.5), b: 56.6 };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(InvertedSliderCrank::points, |p| [(p.o, p.a, m.a), (p.d, p.b, m.c)]);
    for q in &course.positions {
        let points = points(q);
        // The slide is at the angle gamma, here a right angle, to its foot.
        exact((points.a - points.d).norm(), q.b.hypot(m.c), m.a + m.d + q.b);
    }
    let [least, largest] = course.range(|q| q.b);
    exact(least, ((m.d - m.a).powi(2) - m.c * m.c).sqrt(), m.d + m.a);
    exact(largest, ((m.d + m.a).powi(2) - m.c * m.c).sqrt(), m.d + m.a);
}

/// The ram turns back where the slotted arm lies on its line: there the crank's pin is `offset` below the crank's
/// pivot.
#[test]
fn whitworth_returns_faster() {
    let m = Whitworth::default();
    let start = WhitworthCoordinates { theta: FRAC_PI_2, psi: FRAC_PI_2, s: 80.0, phi: degrees(17.5), x: 191.0 };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(Whitworth::points, |p| {
        [(p.o, p.c, m.offset), (p.o, p.pin, m.crank), (p.c, p.e, m.arm), (p.e, p.ram, m.rod)]
    });
    let dip = (m.offset / m.crank).asin();
    let velocity = |q: &WhitworthCoordinates| m.velocity(&m.pose_at(q), 1.0).unwrap().x;
    let [first, second] = course.roots(velocity)[..] else { panic!("two dead centres") };
    assert_abs_diff_eq!(first, PI + dip, epsilon = 1e-13);
    assert_abs_diff_eq!(second, TAU - dip, epsilon = 1e-13);
    let back = second - first;
    assert_abs_diff_eq!((TAU - back) / back, (PI + 2.0 * dip) / (PI - 2.0 * dip), epsilon = 1e-12);
    let [least, largest] = course.range(|q| q.x);
    exact(largest - least, 2.0 * m.arm, m.arm + m.rod);
    // The slotted arm turns all the way round.
    assert_abs_diff_eq!(course.positions[STEPS as usize].psi - course.positions[0].psi, TAU, epsilon = 1e-13);
}

/// The ram turns back with the lever, where the crank is perpendicular to it.
#[test]
fn crank_shaper_returns_faster() {
    let m = CrankShaper::default();
    let start = CrankShaperCoordinates { theta: FRAC_PI_2, psi: FRAC_PI_2, s: 170.0, phi: degrees(-8.0), x: 99.0 };
    let course = turn(&m, start);
    course.closed_form();
    course.rigid(CrankShaper::points, |p| {
        [(p.o, p.c, m.offset), (p.o, p.pin, m.crank), (p.c, p.e, m.lever), (p.e, p.ram, m.rod)]
    });
    let swing = (m.crank / m.offset).asin();
    let velocity = |q: &CrankShaperCoordinates| m.velocity(&m.pose_at(q), 1.0).unwrap().x;
    let [first, second] = course.roots(velocity)[..] else { panic!("two dead centres") };
    assert_abs_diff_eq!(first, PI + swing, epsilon = 1e-13);
    assert_abs_diff_eq!(second, TAU - swing, epsilon = 1e-13);
    let back = second - first;
    assert_abs_diff_eq!((TAU - back) / back, (PI + 2.0 * swing) / (PI - 2.0 * swing), epsilon = 1e-12);
    let [least, largest] = course.range(|q| q.x);
    exact(largest - least, 2.0 * m.lever * m.crank / m.offset, m.lever + m.rod);
    let [least, largest] = course.range(|q| q.psi);
    assert_abs_diff_eq!((largest - least) / 2.0, swing, epsilon = 1e-14);
}

/// The wheel starts and stops without a jolt, and turns by one slot.
#[test]
fn geneva_turns_one_slot() {
    let m = Geneva::default();
    let engaged = FRAC_PI_2 - PI / m.slots;
    let start = GenevaCoordinates { theta: -engaged, psi: PI / m.slots, s: m.crank };
    let course = follow(&m, start, 2.0 * engaged);
    course.closed_form();
    course.rigid(Geneva::points, |p| [(p.o, p.pin, m.crank), (p.o, p.wheel, m.crank / (PI / m.slots).sin())]);
    let [first, middle, last] = [0, 180, 360].map(|step: usize| &course.positions[step]);
    assert_abs_diff_eq!(last.psi - first.psi, -TAU / m.slots, epsilon = 1e-15);
    for end in [first, last] {
        let motion = m.motion(end, 1.0, 0.0).unwrap();
        assert_abs_diff_eq!(motion.rates.psi, 0.0, epsilon = 1e-15);
        exact(motion.outputs.depth.value, 0.0, m.crank);
        // The acceleration jumps there, by omega^2 tan(pi / slots).
        assert_abs_diff_eq!(motion.accelerations.psi.abs(), (PI / m.slots).tan(), epsilon = 1e-14);
    }
    // Fastest in the middle: omega sin / (1 - sin) of half a slot.
    let half = (PI / m.slots).sin();
    assert_abs_diff_eq!(m.velocity(&m.pose_at(middle), 1.0).unwrap().psi, -half / (1.0 - half), epsilon = 1e-14);
}
