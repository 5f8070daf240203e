//! Hart's inversor at the end of its range: both dyads are flat there at once, so that motions cross where the input
//! turns back. Known to fail: followers that take a crossing for a way on and return to it for ever.

use linkage::PathError;
use linkage::continuation::{Direction, Path};

use linkage_gallery::four_bar::*;
use linkage_gallery::hart::*;

#[test]
fn the_end_of_the_range_is_a_dead_point() {
    let m = Hart::default();
    // The links of the first dyad in line: 2 crank cos(theta / 2) = part (long - short).
    let end = 2.0 * (m.part * (m.long - m.short) / (2.0 * m.crank)).acos();
    for branch in HartBranch::all() {
        for theta in [-1.4, 0.2, 1.7] {
            let start = m.assemble(theta, branch).unwrap().coordinates();
            for way in [1.0, -1.0] {
                let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
                let Err(PathError::DeadPoint { gap, .. }) = path.advance_to(way * (end + 0.3)) else {
                    panic!("{start:?}")
                };
                assert!((gap - 0.3).abs() < 1e-7, "{gap}");
                let found = path.position().theta;
                assert!((found - way * end).abs() < 1e-7, "{found} is not {end}");
                // A second call does not search for ever.
                let again = path.advance_to(way * (end + 0.3));
                assert!(matches!(again, Err(PathError::DeadPoint { .. } | PathError::Lost { .. })), "{again:?}");
            }
        }
    }
}

/// A path sent beyond a dead point twice leaves it the same way each time.
#[test]
fn a_dead_point_twice() {
    let m = FourBar::new(80.0, 50.0, 40.0, 60.0);
    let branch = FourBarBranch::all().next().unwrap();
    let end = 1.708_733_323_213_281;
    let left = [1e-4, 1e-3, 0.01, 0.05, 0.2].map(|before| {
        let start = m.assemble(end - before, branch).unwrap().coordinates();
        let mut path = Path::new(&m, &start, Direction::Decreasing).unwrap();
        for _ in 0..2 {
            let found = path.advance_to(end + 0.1);
            assert!(matches!(found, Err(PathError::DeadPoint { .. })), "{found:?}");
        }
        m.branch_of(&m.pose_at(&path.advance_to(end - 0.1).unwrap().position))
    });
    assert_eq!(left, [branch; 5]);
}
