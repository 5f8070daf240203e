//! A four-bar whose lengths miss a change point by epsilon: two motions whose distance is the root of epsilon.
//!
//! Known to fail: a follower with a step of fixed size. With any prediction it cuts the corner where the motion turns
//! aside, and goes on along the other motion.

use std::f64::consts::PI;

use linkage::continuation::{Direction, Event, Path};
use linkage::{Elbow, Mechanism, position};

use linkage_gallery::four_bar::*;

/// Ground 3, crank 1, coupler 3, rocker 1 + epsilon: they are nearly in line where the crank points away.
fn near(epsilon: f64) -> FourBar {
    FourBar::new(3.0, 1.0, 3.0, 1.0 + epsilon)
}

fn start(m: &FourBar, elbow: Elbow, theta: f64) -> FourBarCoordinates {
    m.assemble(theta, FourBarBranch::new(elbow)).unwrap().coordinates()
}

/// True if a follower with a fixed step changes its motion: Newton's method from the prediction of the velocity ratios.
fn fixed_step_changes(m: &FourBar, step: f64) -> bool {
    let mut q = start(m, Elbow::Left, PI - 0.3 * step);
    let before = m.determinant(&m.pose_at(&q));
    let ratios = m.velocity_ratios(&m.pose_at(&q)).unwrap();
    q.theta2 += step;
    q.theta3 += ratios[0] * step;
    q.theta4 += ratios[1] * step;
    let found = position::newton(m, &q).unwrap().coordinates;
    (m.determinant(&m.pose_at(&found)) > 0.0) != (before > 0.0)
}

#[test]
fn round_the_corner() {
    for (exponent, epsilon) in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12].into_iter().enumerate() {
        let m = near(epsilon);
        if exponent > 0 {
            assert!(fixed_step_changes(&m, 0.1), "the case does not bite at {epsilon}");
        }
        for elbow in [Elbow::Left, Elbow::Right] {
            let branch = FourBarBranch::new(elbow);
            let mut path = Path::new(&m, &start(&m, elbow, 2.5), Direction::Increasing).unwrap();
            let mut steps = 0;
            while path.position().theta2 < 3.8 {
                let step = path.advance().unwrap_or_else(|error| panic!("{epsilon} {elbow:?}: {error}"));
                assert_eq!(step.event, None, "{epsilon} {elbow:?}");
                let pose = m.pose_at(&step.position);
                assert_eq!(m.branch_of(&pose), branch, "{epsilon} {:?}", step.position);
                let expected = m.assemble(step.position.theta2, branch).unwrap();
                // The rounding error of the residuals, whose terms have the sum 8, divided by a nearly zero
                // determinant.
                let error = 4e-14 / m.determinant(&expected).abs();
                assert!(
                    (pose.theta4.im - expected.theta4.im).abs() < error.max(1e-13),
                    "{epsilon} {:e} {error:e}",
                    pose.theta4.im - expected.theta4.im
                );
                assert!(
                    (pose.theta4.re - expected.theta4.re).abs() < error.max(1e-13),
                    "{epsilon} {:e} {error:e}",
                    pose.theta4.im - expected.theta4.im
                );
                steps += 1;
            }
            println!("epsilon {epsilon:e}: {steps} steps, {elbow:?}");
            assert!(steps < 400);
            // The corner in one call, there and back.
            let mut path = Path::new(&m, &start(&m, elbow, 2.5), Direction::Increasing).unwrap();
            for theta in [3.8, 2.4, PI + 0.1] {
                let q = path.advance_to(theta).unwrap().position;
                assert_eq!(m.branch_of(&m.pose_at(&q)), branch, "{epsilon} {theta}");
            }
        }
    }
}

/// At epsilon = 0 it is a change point with the tangents of the two motions: ratios 1 and -1/2.
#[test]
fn nothing_missing() {
    let m = near(0.0);
    let mut path = Path::new(&m, &start(&m, Elbow::Left, 2.5), Direction::Increasing).unwrap();
    let event = path.find_map(|step| step.unwrap().event).unwrap();
    let Event::ChangePoint { groups, tangents } = event else { panic!("{event:?}") };
    assert!(groups.iter().eq(["theta3, theta4"]));
    assert!(tangents.len() == 2 && tangents.is_complete());
    let mut ratios = [tangents[0], tangents[1]].map(|rates| rates.theta4 / rates.theta2);
    ratios.sort_by(f64::total_cmp);
    assert!((ratios[0] + 0.5).abs() < 1e-12 && (ratios[1] - 1.0).abs() < 1e-12, "{ratios:?}");
}

/// At the crank angle of the corner the ratio tends to the mean of the two, 1/4, and its derivative to
/// -0.459/sqrt(epsilon): -4.578, -45.93 and -4592.8 in 40-digit arithmetic.
#[test]
fn ratio_in_the_corner() {
    for (epsilon, derivative, digits) in [(1e-2, -4.578, 5e-4), (1e-4, -45.93, 5e-3), (1e-8, -4592.8, 0.05)] {
        let m = near(epsilon);
        let found = [Elbow::Left, Elbow::Right].map(|elbow| {
            let mut path = Path::new(&m, &start(&m, elbow, 2.5), Direction::Increasing).unwrap();
            let q = path.advance_to(PI).unwrap().position;
            let pose = m.pose_at(&q);
            let rate = m.velocity(&pose, 1.0).unwrap();
            (rate.theta4, m.acceleration(&pose, &rate, 0.0).unwrap().theta4)
        });
        println!("{epsilon:e}: {found:?}");
        for (ratio, slope) in found {
            assert!((ratio - 0.25).abs() < 0.2 * epsilon.sqrt(), "{ratio}");
            assert!((slope.abs() - f64::abs(derivative)).abs() <= digits, "{slope}");
        }
    }
}
