//! A six-bar whose second group locks where the first could turn on.
//!
//! Known to fail: programs that check det J alone, which report a singular mechanism but not the group.

use linkage::continuation::{Direction, Event, Path};
use linkage::{Elbow, PathError, PositionError};

use linkage_gallery::six_bar::*;

fn six_bar() -> SixBar {
    SixBar { f: 3.4, g: 3.4, ..SixBar::default() }
}

const BRANCH: SixBarBranch = SixBarBranch::new(Elbow::Left, Elbow::Left);

/// The first crank angle, after one with a position, at which the mechanism cannot be assembled.
fn limits(m: &SixBar) -> (f64, f64, &'static str) {
    let exists = |theta: f64| m.assemble(theta, BRANCH).is_ok();
    let start = (0..360).map(|k| f64::from(k).to_radians()).find(|&theta| exists(theta)).unwrap();
    let (mut low, mut high) = (start, start);
    while exists(high) {
        (low, high) = (high, high + 0.01);
    }
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        *(if exists(middle) { &mut low } else { &mut high }) = middle;
    }
    let Err(PositionError::Unbuildable { group, .. }) = m.assemble(high, BRANCH) else { panic!("it cannot be built") };
    (start, high, group)
}

#[test]
fn the_error_names_the_group() {
    let m = six_bar();
    let (start, limit, group) = limits(&m);
    assert_eq!(group, "theta4, theta5");
    let start = m.assemble(start + 0.01, BRANCH).unwrap().coordinates();
    let mut path = Path::new(&m, &start, Direction::Increasing).unwrap();
    let Err(PathError::DeadPoint { mechanism, group, gap }) = path.advance_to(limit + 0.5) else { panic!("it locks") };
    assert_eq!((mechanism, group), ("SixBar", "theta4, theta5"));
    println!("locks at {}, {limit} by bisection of the assembly", path.position().theta1);
    assert!((gap - 0.5).abs() < 1e-14 && (path.position().theta1 - limit).abs() < 1e-14);
    // Followed further, the second group changes its branch, with one event; the first never does.
    let expected = SixBarBranch { theta4_theta5: Elbow::Right, ..BRANCH };
    for _ in 0..5 {
        let q = path.advance().unwrap().position;
        assert_eq!(m.branch_of(&m.pose_at(&q)), expected);
        assert!(q.theta1 < limit);
    }
    let mut again = Path::new(&m, &start, Direction::Increasing).unwrap();
    let event = again.find_map(|step| step.unwrap().event).unwrap();
    assert_eq!(event, Event::DeadPoint { group: "theta4, theta5" });
}
