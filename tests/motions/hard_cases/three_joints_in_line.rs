//! A four-bar that starts with coupler and rocker in line: J has no inverse at the very start.
//!
//! Known to fail: every program that begins by solving J u' = -A v'.

use linkage::continuation::{Direction, Path};
use linkage::{Elbow, PathError, PositionError};

use linkage_gallery::four_bar::*;

/// The crank is upright: 3, 4 and 2 + 3 are the sides of a right triangle.
fn stretched() -> (FourBar, FourBarCoordinates) {
    let along = (-4_f64).atan2(3.0);
    let q = FourBarCoordinates { theta2: std::f64::consts::FRAC_PI_2, theta3: along, theta4: along };
    (FourBar::new(3.0, 4.0, 2.0, 3.0), q)
}

#[test]
fn both_ways_out() {
    let (m, q) = stretched();
    assert!(matches!(m.velocity_ratios(&m.pose_at(&q)), Err(PositionError::Singular { .. })));
    // The rate of the input is zero, which does not determine the direction.
    for direction in [Direction::Increasing, Direction::Decreasing] {
        assert_eq!(Path::new(&m, &q, direction).err(), Some(PathError::NoDirection { mechanism: "FourBar" }));
    }
    for (theta3, elbow) in [(1.0, Elbow::Left), (-1.0, Elbow::Right)] {
        let direction = Direction::Along(FourBarRates { theta2: 0.0, theta3, theta4: 0.0 });
        let mut path = Path::new(&m, &q, direction).unwrap();
        assert!(path.rates().theta2.abs() < 1e-15);
        let branch = FourBarBranch::new(elbow);
        for _ in 0..5 {
            let step = path.advance().unwrap();
            assert_eq!(step.event, None);
            let pose = m.pose_at(&step.position);
            assert_eq!(m.branch_of(&pose), branch);
            let expected = m.assemble(step.position.theta2, branch).unwrap();
            assert!((pose.theta3.re - expected.theta3.re).abs() < 1e-13);
            assert!((pose.theta3.im - expected.theta3.im).abs() < 1e-13);
        }
    }
}

/// A direction perpendicular to the path determines nothing.
#[test]
fn across() {
    let (m, q) = stretched();
    let none = FourBarRates { theta2: 1.0, theta3: 0.0, theta4: 0.0 };
    assert_eq!(Path::new(&m, &q, Direction::Along(none)).err(), Some(PathError::NoDirection { mechanism: "FourBar" }));
}
