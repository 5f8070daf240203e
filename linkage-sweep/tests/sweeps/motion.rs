//! Rows that are not on one motion.

use linkage::{Elbow, PathError, linkage};
use linkage_sweep::{Column, Plan, Sweep, SweepError, given};

linkage! {
    /// A parallelogram whose frame is tilted, if `d` is `a`.
    #[derive(Debug, Clone, Copy)]
    mechanism Tilted {
        param a = 2, b = 5, d = 2, tilt = 5deg;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = b@tilt + d@psi;
        derive lanes;
    }
}

const BRANCH: TiltedBranch = TiltedBranch::new(Elbow::Left);

/// On the branch a parallelogram becomes an antiparallelogram at 5 and at 185 degrees: these rows are named.
#[test]
fn rows_beyond_a_change_point() {
    let plan = Plan::new().grid("tilt", 0.1, 0.4, 4).turn("theta", 90);
    let sweep = Sweep::new(&Tilted::default(), BRANCH, plan).unwrap().with_case(1).unwrap();
    for case in 0..4 {
        let chunk = sweep.chunk(case * 90 / sweep.rows_per_chunk(), &Column::all::<Tilted>()).unwrap();
        assert_eq!(chunk.rows(), 360);
        let tilt = 0.1 * (case + 1) as f64;
        let is_parallel = |row: u64| {
            let theta = f64::from(u32::try_from(row - case * 90).unwrap()) * 4.0_f64.to_radians();
            let position = Tilted { tilt, ..Tilted::default() }.assemble(theta, BRANCH).unwrap().coordinates();
            (position.psi - theta).sin().abs() < 1e-9
        };
        let rows = case * 90..(case + 1) * 90;
        let expected: Vec<u64> = rows.filter(|&row| is_parallel(row) != is_parallel(case * 90)).collect();
        let off = sweep.off_motion(case).unwrap();
        assert!(off.iter().all(|off| off.ended.is_none()));
        assert_eq!(off.iter().map(|off| off.row).collect::<Vec<_>>(), expected);
        assert!((40..50).contains(&expected.len()), "{}", expected.len());
    }
    assert!(matches!(sweep.off_motion(4), Err(SweepError::OutOfRange { quantity: "case", number: 4, count: 4 })));
}

/// A rocker has two motions in one turn, of which the second begins where the first has ended.
#[test]
fn rows_beyond_a_dead_point() {
    let m = Tilted { a: 3.0, b: 2.0, d: 4.0, tilt: 0.3 };
    let sweep = Sweep::new(&m, BRANCH, Plan::new().turn("theta", 60)).unwrap().with_case(1).unwrap();
    assert_eq!(sweep.off_motion(0).unwrap(), []);
    // A case of both factors has two designs.
    let sweep = Sweep::new(&m, BRANCH, Plan::new().grid("tilt", 0.1, 0.2, 2).turn("theta", 60)).unwrap();
    let error = sweep.with_case(2).unwrap().off_motion(0).unwrap_err();
    assert!(matches!(error, SweepError::SeveralDesigns { case: 0 }), "{error}");
    // Links that do not reach anywhere.
    let m = Tilted { a: 1.0, b: 9.0, d: 1.0, tilt: 0.0 };
    let plan = Plan::new().constant("b", 9.0).constant("d", 20.0).turn("theta", 8);
    let sweep = Sweep::new(&m, BRANCH, plan).unwrap().with_case(1).unwrap();
    let error = sweep.off_motion(0).unwrap_err();
    assert!(matches!(error, SweepError::NoMotion { case: 0, error: PathError::Position(_) }), "{error}");
    assert!(matches!(sweep.chunk(0, &[given("theta")]), Ok(chunk) if chunk.rejected() == 8));
}
