//! A start that Newton's method takes to the mirrored position.
//!
//! Known to fail: solvers that return any solution: part of these guesses gives the mirrored one.

use linkage::continuation::{Direction, Path};
use linkage::{PathError, PositionError, position};

use linkage_gallery::four_bar::*;

#[test]
fn never_mirrored_silently() {
    let m = FourBar::default();
    let (mut followed, mut mirrored, mut not_found) = (0, 0, 0);
    for i in 0..60 {
        for j in 0..60 {
            let angle = |k: i32| f64::from(k) / 60.0 * std::f64::consts::TAU - std::f64::consts::PI;
            let guess = FourBarCoordinates { theta2: 0.35, theta3: angle(i), theta4: angle(j) };
            let side = m.branch_of(&m.pose_at(&guess)).theta3_theta4;
            let found = position::newton_any_branch(&m, &guess)
                .map(|found| m.branch_of(&m.pose_at(&found.coordinates)).theta3_theta4);
            match Path::new(&m, &guess, Direction::Increasing) {
                Ok(path) => {
                    assert_eq!(m.branch_of(&m.pose_at(&path.position())).theta3_theta4, side);
                    followed += 1;
                }
                Err(PathError::Position(PositionError::OtherBranch { mechanism, group })) => {
                    assert_eq!((mechanism, group), ("FourBar", "theta3, theta4"));
                    assert_ne!(found.unwrap(), side);
                    mirrored += 1;
                }
                Err(PathError::Position(PositionError::NotConverged { .. })) => not_found += 1,
                Err(error) => panic!("{error}"),
            }
        }
    }
    println!("of 3600 starts {followed} are followed, {mirrored} are mirrored, {not_found} not found");
    assert!(followed > 2000 && mirrored > 100);
}
