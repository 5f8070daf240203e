//! Full turns.

use linkage_interval::certify::{self, Certificate, CertifyError, End};

use crate::loops::Loops;
use crate::shapes::{FourBar, WrongA, WrongGamma, WrongJ};

#[test]
fn the_sheets_four_bar_turns_fully() {
    // The sheet has all vectors along the loop; here the rocker points the other way.
    let four_bar = Loops::<FourBar, f64>::new([80.0, 20.0, 50.0, 70.0]);
    let start = Loops::<FourBar, f64>::at([1.2, -0.9 + std::f64::consts::PI], 0.35);
    let time = std::time::Instant::now();
    let certificate = certify::turn(&four_bar, &start).unwrap();
    println!("{} boxes, {} tests, {:?}, {:?}", certificate.boxes(), certificate.tests(), certificate.end(), time.elapsed());
    assert!(certificate.is_closed());
}

#[test]
fn nortons_four_bar_turns_fully() {
    let four_bar = Loops::<FourBar, f64>::new([100.0, 40.0, 120.0, 80.0]);
    let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
    let certificate = certify::turn(&four_bar, &start).unwrap();
    println!("{} boxes, {} tests, {:?}", certificate.boxes(), certificate.tests(), certificate.end());
    assert!(certificate.is_closed());
}

#[test]
fn parallelograms_near_their_change_point() {
    for eps in [1e-1, 1e-2, 1e-4, 1e-6] {
        let four_bar = Loops::<FourBar, f64>::new([3.0, 1.0, 3.0, 1.0 + eps]);
        let start = Loops::<FourBar, f64>::at([0.05, 0.5], 0.5);
        let certificate = certify::turn(&four_bar, &start).unwrap();
        println!("{eps}: {} boxes, {} tests, {:?}", certificate.boxes(), certificate.tests(), certificate.end());
        assert!(certificate.is_closed());
    }
    let four_bar = Loops::<FourBar, f64>::new([3.0, 1.0, 3.0, 1.0]);
    let error = certify::turn(&four_bar, &Loops::<FourBar, f64>::at([0.05, 0.5], 0.5)).err();
    println!("{error:?}");
    assert!(matches!(error, Some(CertifyError::Singular { .. })));
}
