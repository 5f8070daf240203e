//! A crank that has made a million turns.
//!
//! Known to fail: an absolute tolerance on residuals, which ignores the ulp of an angle of 6e6 radians, and steps that
//! accumulate rounding errors.

use std::f64::consts::TAU;

use linkage::Elbow;
use linkage::continuation::{Direction, Path};

use linkage_gallery::four_bar::*;

const BRANCH: FourBarBranch = FourBarBranch::new(Elbow::Left);

/// Follows `turns` turns with one check a turn.
fn turn(from: f64, turns: u32, looks: u32) {
    let m = FourBar::default();
    let start = m.assemble(from, BRANCH).unwrap().coordinates();
    let mut path = Path::new(&m, &FourBarCoordinates { theta2: from, ..start }, Direction::Increasing).unwrap();
    for look in 1..=looks {
        let theta2 = from + TAU * f64::from(turns) * f64::from(look) / f64::from(looks);
        let q = path.advance_to(theta2).unwrap().position;
        let expected = m.assemble(theta2, BRANCH).unwrap();
        assert_eq!(q.theta2, theta2);
        // The rocker's angles are small, and their sines and cosines are those of this very input.
        let error = (q.theta3 - expected.theta3_angle).abs().max((q.theta4 - expected.theta4_angle).abs());
        assert!(error < 1e-14, "{error:e} at {theta2}");
    }
}

#[test]
fn the_last_turns_of_a_million() {
    turn(TAU * (1e6 - 50.0), 50, 77);
}

/// `TURNS=1000000 cargo test --release --test motions many_turns` makes so many, in 69 s.
#[test]
fn turns_from_the_start() {
    let turns = linkage_trials::count("TURNS", 100, 1000);
    turn(0.3, turns, turns / 10);
}
