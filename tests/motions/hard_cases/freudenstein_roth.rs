//! The curve of Freudenstein and Roth with its four limit points.
//!
//! Known to fail: any method that steps x3, which turns back twice on the way to the root. The start, the target and
//! the limit points are those of PITCON's problem 1 (W. C. Rheinboldt and J. V. Burkardt, "Algorithm 596: a program
//! for a locally parameterized continuation process", ACM Transactions on Mathematical Software 9, 1983, with seven
//! digits: pitcon66_prb1.f); the further digits are theirs continued in 40-digit arithmetic, rounded.

use linkage::continuation::{Direction, Event, Path};
use linkage::{PathError, linkage};

linkage! {
    /// Two equations of F. Freudenstein and B. Roth ("Numerical solution of systems of nonlinear equations", Journal of
    /// the ACM 10, 1963) with a third unknown that leads from (15, -2) to their root (5, 4): a curve with four limit
    /// points, the standard test of the continuation program PITCON (W. C. Rheinboldt and J. V. Burkardt, 1983).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FreudensteinRoth {
        coordinate x1, x2, x3;

        equation x1 - x2^3 + 5*x2^2 - 2*x2 - 13 + 34*(x3 - 1) = 0;
        equation x1 + x2^3 + x2^2 - 14*x2 - 29 + 10*(x3 - 1) = 0;

        drive FoldsOfX3 by x3;
        drive FoldsOfX1 by x1;
    }
}

const LIMITS_OF_X1: [[f64; 3]; 2] = [
    [14.283_091_250_093_856, -1.741_376_892_197_492_1, 0.258_577_871_376_728_2],
    [61.669_362_581_147_86, 1.983_801_134_621_734_6, -0.663_879_742_243_337_3],
];
const LIMITS_OF_X3: [[f64; 3]; 2] = [
    [20.485_857_827_923_454, -0.896_805_253_274_476_5, 0.587_587_325_408_120_1],
    [61.020_315_011_582_72, 2.230_138_586_607_81, -0.686_352_757_506_885_5],
];
/// Relative error of the published figures.
const PUBLISHED: [[f64; 3]; 4] = [
    [14.28309, -1.741377, 0.2585779],
    [61.66936, 1.983801, -0.6638797],
    [20.48586, -0.8968053, 0.5875873],
    [61.02031, 2.230139, -0.6863528],
];

fn start() -> FreudensteinRothCoordinates {
    FreudensteinRothCoordinates { x1: 15.0, x2: -2.0, x3: 0.0 }
}

#[track_caller]
fn agrees(q: &FreudensteinRothCoordinates, expected: [f64; 3]) {
    for (found, expected) in [q.x1, q.x2, q.x3].into_iter().zip(expected) {
        assert!((found - expected).abs() <= 4e-15 * expected.abs().max(1.0), "{found} is not {expected}");
    }
}

#[test]
fn published_figures() {
    for (ours, theirs) in LIMITS_OF_X1.iter().chain(&LIMITS_OF_X3).zip(PUBLISHED) {
        for (ours, theirs) in ours.iter().zip(theirs) {
            assert!((ours - theirs).abs() <= 1e-6 * theirs.abs(), "{ours} {theirs}");
        }
    }
}

/// Driven by x3, the limits of x3 are dead points, and those of x1 are zeros of a rate.
#[test]
fn driven_by_x3() {
    let m = FoldsOfX3::default();
    let mut path = Path::new(&m, &start(), Direction::Increasing).unwrap();
    let (mut of_x1, mut of_x3) = (Vec::new(), Vec::new());
    while path.position().x2 < 3.9 {
        let step = path.advance_watching(|_, rates| rates.x1).unwrap();
        match step.event {
            Some(Event::Zero) => of_x1.push(step.position),
            Some(Event::DeadPoint { group: "x1, x2" }) => of_x3.push(step.position),
            None => {}
            other => panic!("{other:?}"),
        }
    }
    assert_eq!((of_x1.len(), of_x3.len()), (2, 2));
    of_x1.iter().zip(LIMITS_OF_X1).for_each(|(q, expected)| agrees(q, expected));
    of_x3.iter().zip(LIMITS_OF_X3).for_each(|(q, expected)| agrees(q, expected));
    agrees(&path.advance_to(1.0).unwrap().position, [5.0, 4.0, 1.0]);
    // It is not reached by the input alone.
    let error = Path::new(&m, &start(), Direction::Increasing).unwrap().advance_to(1.0);
    assert!(matches!(error, Err(PathError::DeadPoint { mechanism: "FoldsOfX3", .. })), "{error:?}");
}

/// Driven by x1, the limits of x1 are dead points, and those of x3 are zeros of a rate.
#[test]
fn driven_by_x1() {
    let m = FoldsOfX1::default();
    let mut path = Path::new(&m, &start(), Direction::Decreasing).unwrap();
    let (mut of_x1, mut of_x3) = (Vec::new(), Vec::new());
    while path.position().x2 < 3.9 {
        let step = path.advance_watching(|_, rates| rates.x3).unwrap();
        match step.event {
            Some(Event::Zero) => of_x3.push(step.position),
            Some(Event::DeadPoint { .. }) => of_x1.push(step.position),
            _ => {}
        }
    }
    of_x1.iter().zip(LIMITS_OF_X1).for_each(|(q, expected)| agrees(q, expected));
    of_x3.iter().zip(LIMITS_OF_X3).for_each(|(q, expected)| agrees(q, expected));
    assert_eq!((of_x1.len(), of_x3.len()), (2, 2));
}
