//! Loops that follow from the others: a position where they close, and the error where they do not.

use linkage::continuation::{Direction, Path};
use linkage::{Assembled, Elbow, PathError, PositionError, linkage};

use linkage_gallery::implied_loops::ImpliedLoops;

linkage! {
    /// A coupler on three parallel cranks: the loop of the third follows from that of the other two if `middle_crank` is as
    /// long as `crank`, and if the coupler stays parallel to the ground.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ThreeCranks {
        param crank = 30, middle_crank = 30, span = 80, middle = 35;
        input theta;
        unknown phi, psi;
        derive lanes;

        loop crank@theta + span@phi = span@0 + crank@psi;
        /// The third crank.
        implied loop crank@theta + middle@phi = middle@0 + middle_crank@psi;

        point Middle = middle@0 + middle_crank@psi;
    }

    /// A scissor lift of two stages with both loops of each: the second of each stage is the mirror image of the first.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Scissor {
        param arm = 50;
        input s;
        unknown phi, psi, h, lift;

        loop arm@phi = (s, h);
        implied loop (0, h) + arm@(-phi) = (s, 0);
        loop (0, h) + arm@psi = (s, lift);
        implied equation lift = 2*h;
        implied loop (0, lift) + arm@(-psi) = (s, h);

        point Top = (s, lift);
    }
}

fn branches() -> [ThreeCranksBranch; 2] {
    [Elbow::Left, Elbow::Right].map(ThreeCranksBranch::new)
}

/// The name of the loop in errors.
const THIRD: &str = "implied loop 1 (The third crank)";

fn is_third(error: PositionError) -> bool {
    matches!(error, PositionError::NotImplied { mechanism: "ThreeCranks", equation: THIRD, residual } if residual > 1e-6)
}

/// On one branch the coupler stays parallel; on the other it does not, and there is no position with three cranks.
#[test]
fn three_parallel_cranks() {
    let m = ThreeCranks::default();
    for degrees in (1..180).chain(181..360) {
        let theta = f64::from(degrees).to_radians();
        let found: Vec<_> = m.branches(theta).unwrap().collect();
        let [Assembled { branch, pose }] = found.as_slice() else { panic!("{}", found.len()) };
        let accuracy = 8.0 * f64::EPSILON / theta.sin().abs();
        assert!((pose.psi.re - theta.cos()).abs() <= accuracy && (pose.phi.re - 1.0).abs() <= accuracy, "{pose:?}");
        m.check_implied(pose).unwrap();
        let other = branches().into_iter().find(|other| other != branch).unwrap();
        let errors = [
            m.assemble(theta, other).unwrap_err(),
            m.kinematics(theta, other, 1.0, 0.0).unwrap_err(),
            m.full_kinematics(theta, other, 1.0, 0.0).unwrap_err(),
        ];
        for error in errors {
            assert!(is_third(error), "{error}");
        }
        let moving = m.kinematics(theta, *branch, 1.0, 0.0).unwrap();
        assert!((moving.rates.psi - 1.0).abs() < 1e-12 && moving.rates.phi.abs() < 1e-12);
    }
}

/// A wrong length is found by each function that searches a position.
#[test]
fn a_crank_of_another_length() {
    let m = ThreeCranks { middle_crank: 30.1, ..ThreeCranks::default() };
    assert_eq!(ThreeCranks::<f64>::DERIVATION.implied.len(), 2);
    let guess = ThreeCranksCoordinates { theta: 1.0, phi: 0.0, psi: 1.0 };
    let errors = [m.solve(&guess).unwrap_err(), m.solve_any_branch(&guess).unwrap_err()];
    assert!(errors.into_iter().all(is_third), "{errors:?}");
    assert!(m.branches(1.0).unwrap().next().is_none());
    let Err(PathError::Position(error)) = Path::new(&m, &guess, Direction::Increasing).map(|_| ()) else {
        panic!("a path begins where a loop is open")
    };
    assert!(is_third(error));
    assert_eq!(
        m.solve(&guess).unwrap_err().to_string(),
        "implied loop 1 (The third crank) of ThreeCranks does not close at this position: relative residual 4.2e-4; \
         check the lengths and the branch"
    );
}

/// A path over the change point keeps the motion on which the loop closes.
#[test]
fn a_path_of_three_cranks() {
    let m = ThreeCranks::default();
    let guess = ThreeCranksCoordinates { theta: 1.0, phi: 0.0, psi: 1.0 };
    let mut path = Path::new(&m, &guess, Direction::Increasing).unwrap();
    let end = path.advance_to(6.0).unwrap().position;
    assert!((end.psi - 6.0).abs() < 1e-12, "{end:?}");
}

/// Near a dead point a position has half of the digits, an error of about sqrt(epsilon); implied loops must pass there too.
#[test]
fn implied_loops_near_a_dead_point() {
    let m = ThreeCranks::default();
    let mut found = 0;
    for power in 3..40 {
        for theta in [f64::from(power).exp2().recip(), std::f64::consts::PI - f64::from(power).exp2().recip()] {
            found += m.branches(theta).unwrap().count();
        }
    }
    assert!(found >= 74, "{found}");
}

#[test]
fn both_sides_of_a_scissor_lift() {
    let m = Scissor::default();
    for s in 1..50 {
        let s = f64::from(s);
        let found: Vec<_> = m.branches(s).unwrap().map(|found| found.pose).collect();
        // Up or down; a stage that folds back has no mirror image.
        let lifts: Vec<f64> = found.iter().map(|pose| m.points(pose).unwrap().top.y).collect();
        let height = 2.0 * (2500.0 - s * s).sqrt();
        assert_eq!(lifts.len(), 2, "{lifts:?}");
        assert!(lifts.iter().all(|lift| (lift.abs() - height).abs() < 1e-12 * height), "{lifts:?} {height}");
    }
}

/// A turn of a linkage whose outer loop follows from the others, on all branches.
#[test]
fn all_loops_of_a_six_bar() {
    let m = ImpliedLoops::default();
    let count = (0..360).map(|degrees| m.branches(f64::from(degrees).to_radians()).unwrap().count()).sum::<usize>();
    assert_eq!(count, 4 * 360);
}
