//! Motions without a certificate.

use linkage_interval::Interval;
use linkage_interval::certify::{self, Certify, CertifyError};
use linkage_runtime::Column;

use crate::certify::loops::{Loops, Shape};
use crate::certify::shapes::{FourBar, UserFunction, WrongA, WrongGamma, WrongJ};

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

/// The crank of this four-bar turns back, and the search for the dead point ahead takes tests, too: whatever their number,
/// a search without tests left says so, and calls no group singular.
#[test]
fn tests_that_are_spent_are_no_singularity() {
    let lengths = [4.0, 3.0, 2.0, 2.5];
    let four_bar = Loops::<FourBar, f64>::new(lengths);
    let start = Loops::<FourBar, f64>::at(crate::certify::random::four_bar(lengths, 1.0, 0.5).unwrap(), 0.5);
    let (mut spent, mut before) = (0, 0.0);
    for most in 1..200 {
        match Certify::new(&four_bar).most_tests(most).turn(&start).err() {
            Some(CertifyError::Exhausted { boxes, input, .. }) => {
                assert!(boxes <= most && input >= before, "{most}: {boxes} {input}");
                (spent, before) = (most, input);
            }
            Some(CertifyError::DeadPoint { .. }) => assert!(spent > 5 && most > spent, "{most}"),
            other => panic!("{most}: {other:?}"),
        }
    }
    assert!(spent < 199, "{spent}");
}

/// Tolerances make the bounds too wide long before a group may be singular.
#[test]
fn wide_tolerances_are_no_singularity() {
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
    for tolerance in [0.7e-2, 0.8e-2, 0.9e-2, 1e-2, 1.1e-2] {
        let error = Certify::new(&four_bar).tolerance(tolerance).turn(&start).err();
        assert!(matches!(error, Some(CertifyError::Undecided { .. })), "{tolerance}: {error:?}");
    }
}

/// A turn of an input that is no angle is another mistake than a number that is not finite.
#[test]
fn messages_say_what_is_wrong() {
    let no_turn = CertifyError::NoTurn { mechanism: "Wheels" };
    assert_eq!(
        no_turn.to_string(),
        "the input of Wheels is used as no angle, so that it has no turn: certify a range of it with `range`"
    );
    let exhausted = CertifyError::Exhausted { mechanism: "Wheels", boxes: 7, input: 2.5 };
    assert_eq!(
        exhausted.to_string(),
        "the motion of Wheels is certified up to the input 2.5 by 7 boxes, which took all tests allowed: raise `most_tests`"
    );
    let four_bar = Loops::<FourBar, f64>::new(LENGTHS);
    let start = Loops::<FourBar, f64>::at([0.35, 1.0], 0.7);
    let error = Certify::new(&four_bar).turns(0).turn(&start).err();
    assert_eq!(error, Some(CertifyError::Invalid { mechanism: "Loops", what: "the number of turns" }));
}
