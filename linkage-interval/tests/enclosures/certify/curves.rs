//! Motions through dead points.

use linkage_interval::certify::{self, CertifyError};
use linkage_trials::count;

use crate::certify::loops::Loops;
use crate::certify::shapes::{DOUBLE_BUTTERFLY, DoubleButterfly, FourBar, MODES};

/// No link of this four-bar can turn fully: crank^2 + ground^2 - 2 crank ground cos theta = (coupler + rocker)^2 at the
/// limits of its crank, and its two positions at one input are on one curve.
#[test]
fn a_four_bar_without_full_turn() {
    let four_bar = Loops::<FourBar, f64>::new([4.0, 3.0, 2.0, 2.5]);
    let [start, other] = [1.0, -1.0].map(|side| {
        Loops::<FourBar, f64>::at(crate::certify::random::four_bar([4.0, 3.0, 2.0, 2.5], side, 0.5).unwrap(), 0.5)
    });
    let limit = ((9.0_f64 + 16.0 - 4.5 * 4.5) / 24.0).acos();
    let is_limit =
        |found: linkage_interval::Interval, limit: f64| found.width() < 1e-13 && (found.middle() - limit).abs() < 1e-14;
    match certify::turn(&four_bar, &start) {
        Err(CertifyError::DeadPoint { limit: found, group: "phi, psi", .. }) => {
            assert!(is_limit(found, limit), "{found:?}")
        }
        other => panic!("{:?}", other.err()),
    }
    assert!(certify::range(&four_bar, &start, limit - 1e-9).is_ok());
    assert!(certify::range(&four_bar, &start, limit + 1e-9).is_err());
    let curve = certify::curve(&four_bar, &start).unwrap();
    assert!(curve.boxes() <= 30, "{}", curve.boxes());
    assert_eq!((curve.input_turns(), curve.turns()), (0, [0, 0].as_slice()));
    let found: Vec<_> = curve.dead_points().iter().map(|point| (point.input, point.is_largest)).collect();
    assert_eq!(found.len(), 2);
    let line = curve.to_string();
    assert_eq!(line, "Loops: one closed curve, on which v turns back at 78.58484°, -78.58484°");
    assert!(is_limit(found[0].0, limit) && found[0].1, "{found:?}");
    assert!(is_limit(found[1].0, -limit) && !found[1].1, "{found:?}");
    assert!(curve.passes(&start) && curve.passes(&other));
    // The pin moves on the arc of the rocker about (4, 0): its y is up to the length of the rocker.
    let y = curve.quantities()[1];
    assert!(y.is_sharp && y.largest.contains(2.5) && y.least.contains(-2.5), "{y:?}");
}

/// Five of its eight positions turn fully; two lock at one limit of the crank, on one curve, and one at another. All of
/// them with the variable BUTTERFLY.
#[test]
fn positions_of_the_double_butterfly() {
    let butterfly = Loops::<DoubleButterfly, f64>::new(DOUBLE_BUTTERFLY);
    let starts = MODES.map(|mode| Loops::<DoubleButterfly, f64>::at(mode, 0.0));
    let shortest = certify::turn(&butterfly, &starts[4]).unwrap();
    assert!(shortest.is_closed() && shortest.boxes() <= 14);
    if count("BUTTERFLY", 0, 1) == 0 {
        return;
    }
    let mut limits = Vec::new();
    for start in &starts {
        match certify::turn(&butterfly, start) {
            Ok(certificate) => {
                assert!(certificate.is_closed());
                assert!(certificate.boxes() <= 22);
            }
            Err(CertifyError::DeadPoint { limit, .. }) => limits.push(limit),
            Err(error) => panic!("{error}"),
        }
    }
    let [one, other, third] = <[_; 3]>::try_from(limits).unwrap();
    assert!(one.intersection(third).is_some() && one.intersection(other).is_none());
    assert!((one.middle() - 4.560_976_631_084_45).abs() < 1e-12 && one.width() < 1e-12);
    let curve = certify::curve(&butterfly, &starts[0]).unwrap();
    assert_eq!(curve.dead_points().len(), 2);
    let on_curve: Vec<_> = starts.iter().map(|start| curve.passes(start)).collect();
    assert_eq!(on_curve, [true, false, false, false, false, false, true, false]);
}
