//! Motions without a certificate.

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certify, CertifyError};
use linkage_runtime::Column;

use crate::loops::{Loops, Shape};
use crate::shapes::{FourBar, UserFunction, WrongA, WrongGamma, WrongJ};

const LENGTHS: [f64; 4] = [100.0, 40.0, 120.0, 80.0];

fn error_of<S: Shape<P = <FourBar as Shape>::P, U = <FourBar as Shape>::U>>(lengths: [f64; 4]) -> CertifyError {
    let start = Loops::<S, f64>::at([0.35, 1.0], 0.7);
    certify::turn(&Loops::<S, f64>::new(lengths), &start).err().unwrap()
}

#[test]
fn derivatives_that_contradict_psi_are_an_error() {
    for (error, expected) in [
        (error_of::<WrongJ>(LENGTHS), "J"),
        (error_of::<WrongA>(LENGTHS), "A"),
        (error_of::<WrongGamma>(LENGTHS), "gamma"),
    ] {
        assert_eq!(error, CertifyError::Contradiction { mechanism: "Loops", what: expected });
    }
}

#[test]
fn a_user_function_has_no_enclosure() {
    let error = error_of::<UserFunction>(LENGTHS);
    assert_eq!(error, CertifyError::UserFunction { mechanism: "Loops", group: "phi, psi", function: "lift" });
}

#[test]
fn numbers_that_are_not_finite_are_an_error() {
    for wrong in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            error_of::<FourBar>([wrong, 40.0, 120.0, 80.0]),
            CertifyError::Invalid { what: "the parameters", .. }
        ));
        let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
        let start = Loops::<FourBar, f64>::at([0.35, wrong], 0.7);
        assert!(matches!(
            certify::turn(&four_bar, &start).err(),
            Some(CertifyError::Invalid { what: "the start", .. })
        ));
        let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
        for to in [wrong, 0.7] {
            let error = certify::range(&four_bar, &start, to).err();
            assert!(matches!(error, Some(CertifyError::Invalid { what: "the range of the input", .. })));
        }
    }
}

#[test]
fn a_four_bar_that_cannot_be_assembled_has_no_position() {
    for lengths in [[100.0, 1.0, 20.0, 30.0], [0.0; 4], [100.0, 40.0, 0.0, 80.0]] {
        assert!(
            matches!(error_of::<FourBar>(lengths), CertifyError::NoPosition { group: "phi, psi", .. }),
            "{lengths:?}"
        );
    }
}

#[test]
fn a_length_of_any_sign_makes_a_group_singular() {
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
    let all =
        Column::from([[100.0; 2], [40.0; 2], [-1.0, 121.0], [80.0; 2]]).map(|[a, b]| Interval::new(a, b).unwrap());
    let error = Certify::new(&four_bar).parameters(all).turn(&start).err();
    assert!(matches!(error, Some(CertifyError::NoPosition { group: "phi, psi", .. })), "{error:?}");
}

#[test]
fn the_work_is_bounded() {
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
    let error = Certify::new(&four_bar).most_tests(5).turn(&start).err();
    assert!(matches!(error, Some(CertifyError::Exhausted { boxes: 1..=5, input, .. }) if input > 0.7), "{error:?}");
}
