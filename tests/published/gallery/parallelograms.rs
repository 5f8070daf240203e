//! Links that stay parallel.

use approx::assert_abs_diff_eq;
use std::f64::consts::TAU;

use super::course::{STEPS, degrees, follow};
use super::exactness::{EPSILONS, exact};

use linkage_gallery::coupled_wheels::*;
use linkage_gallery::pantograph::*;

/// The pen draws what the tracer draws, `ratio` times as large.
#[test]
fn pantograph_copies() {
    let m = Pantograph::default();
    let size = (m.a + m.b) * m.ratio;
    let mut q = PantographCoordinates { x: 5.0, y: 0.0, alpha: 0.9, beta: -0.6, gamma: 0.9, delta: -0.6 };
    for step in 0..=STEPS {
        let angle = degrees(f64::from(step));
        (q.x, q.y) = (4.0 + angle.cos(), 1.0 + 2.0 * angle.sin());
        let solution = m.solve(&q).unwrap();
        q = solution.coordinates;
        let points = m.points(&m.pose_at(&q)).unwrap();
        for axis in 0..2 {
            exact(points.pen[axis], m.ratio * points.tracer[axis], size);
        }
        // Velocity and acceleration too are `ratio` times as large, for any motion of the tracer.
        let motion = m.motion(&q, PantographInputs { x: 0.3, y: -0.7 }, PantographInputs { x: -0.2, y: 0.4 }).unwrap();
        exact(motion.points.pen.velocity.x, m.ratio * 0.3, size);
        exact(motion.points.pen.velocity.y, m.ratio * -0.7, size);
        exact(motion.points.pen.acceleration.x, m.ratio * -0.2, size);
        exact(motion.points.pen.acceleration.y, m.ratio * 0.4, size);
    }
}

/// The parallelogram is followed through both change points, between the steps at half degrees.
#[test]
fn coupled_wheels_stay_parallel() {
    let m = CoupledWheels::default();
    let half = degrees(0.5);
    let start = CoupledWheelsCoordinates { theta: half, rod: 0.0, follower: half };
    let course = follow(&m, start, TAU);
    course.closed_form();
    course.rigid(CoupledWheels::points, |p| {
        [(p.a, p.b, m.crank), (p.a, p.d, m.base), (p.b, p.c, m.base), (p.c, p.d, m.crank)]
    });
    for q in &course.positions {
        // The Jacobian is singular with the sine of the crank's angle.
        let sine = q.theta.sin().abs();
        let error = EPSILONS * f64::EPSILON / sine;
        assert_abs_diff_eq!(q.rod, 0.0, epsilon = error);
        assert_abs_diff_eq!(q.follower, q.theta, epsilon = TAU * error);
        let ratios = m.velocity_ratios(&m.pose_at(q)).unwrap();
        assert_abs_diff_eq!(ratios[0], 0.0, epsilon = error / sine);
        assert_abs_diff_eq!(ratios[1], 1.0, epsilon = error / sine);
    }
}
