//! Two cranks and a pair of arms.

use approx::assert_abs_diff_eq;
use std::f64::consts::{PI, TAU};

use super::course::{STEPS, degrees, turn};
use super::exactness::exact;

use linkage_gallery::five_bar::*;
use linkage_gallery::geared_five_bar::*;

/// Equal cranks that move as in a mirror keep the pen on the line of symmetry.
#[test]
fn five_bar_is_symmetric() {
    let m = FiveBar { a: 1.0, b: 2.75, c: 2.75, d: 1.0, e: 3.0 };
    let size = m.a + m.b + m.c + m.d + m.e;
    let mut q = FiveBarCoordinates { theta1: 0.0, theta2: degrees(79.5), theta3: degrees(100.5), theta4: PI };
    for step in 0..=STEPS {
        q.theta1 = degrees(f64::from(step));
        q.theta4 = PI - q.theta1;
        let solution = m.solve(&q).unwrap();
        q = solution.coordinates;
        let motion = m
            .motion(&q, FiveBarInputs { theta1: 1.0, theta4: -1.0 }, FiveBarInputs { theta1: 0.0, theta4: 0.0 })
            .unwrap();
        exact(motion.points.p.position.x, m.e / 2.0, size);
        exact(motion.points.p.velocity.x, 0.0, size);
        exact(motion.points.p.acceleration.x, 0.0, size);
        assert_abs_diff_eq!(q.theta2 + q.theta3, PI, epsilon = 1e-14);
    }
}

/// Geared two to one, the second crank turns twice backwards in one turn of the first, and all begins again.
#[test]
fn geared_five_bar_has_the_period_of_its_slower_crank() {
    let m = GearedFiveBar::default();
    let points = |q: &_| m.points(&m.pose_at(q)).unwrap();
    let start = GearedFiveBarCoordinates { theta1: 0.0, theta2: 0.5, theta3: 2.0, theta4: m.phase };
    let course = turn(&m, start);
    course.closed_form();
    let [first, half, last] = [0, 180, 360].map(|step: usize| course.positions[step]);
    assert_abs_diff_eq!(last.theta4 - first.theta4, m.ratio * TAU, epsilon = 1e-13);
    let p = |q: &_| points(q).p;
    assert_abs_diff_eq!((p(&last) - p(&first)).norm(), 0.0, epsilon = 1e-13);
    assert!((p(&half) - p(&first)).norm() > 0.1);
}
