//! Numbers that are not valid.

use super::{bearing, equations, guide, reaction, solved};
use linkage_dynamics::contact::validate_contacts;
use linkage_dynamics::{Contact, ContactCoordinate, ContactLaw, MotionError};
use linkage_runtime::{Column, D, InputError, PositionError};

#[test]
fn a_factor_is_finite_and_not_negative() {
    let contact = |factor: f64| Contact::<f64, D<1>, D<1>> {
        name: "friction on phi",
        along: ContactCoordinate { value: 0.0, unknowns: Column::zeros(), inputs: Column::zeros(), bias: 0.0 },
        law: ContactLaw::Bearing { factor },
    };
    assert!(validate_contacts("Scene", [contact(0.0)]).is_ok());
    let negative = validate_contacts("Scene", [contact(-0.1)]).unwrap_err();
    let named = MotionError::Input(InputError::OutOfRange {
        of: Some("Scene"),
        quantity: "friction on phi",
        value: -0.1,
        least: 0.0,
        most: f64::MAX,
    });
    assert_eq!(negative, named);
    for factor in [f64::NAN, f64::INFINITY] {
        let found = validate_contacts("Scene", [contact(factor)]);
        let named = PositionError::NotFinite { mechanism: "Scene", quantity: "friction on phi" };
        assert_eq!(found, Err(named.into()));
    }
}

/// Reactions that are missing or not finite never give accelerations.
#[test]
fn a_reaction_that_is_missing_or_not_finite_is_an_error() {
    let contact = bearing("friction", 0.3, [1.0], 0.0);
    let missing = solved(&equations([[1.0]], [1.0], [(contact, None)])).unwrap_err();
    assert_eq!(missing, PositionError::NotFinite { mechanism: "Scene", quantity: "friction" }.into());
    for rate in [0.0, 1.0] {
        for number in [f64::NAN, f64::INFINITY] {
            for place in 0..3 {
                let mut numbers = [1.0, 0.0, 0.0];
                numbers[place] = number;
                let normal = guide(reaction(numbers[0], [numbers[1]], [numbers[2]]));
                let found = solved(&equations([[1.0]], [1.0], [(bearing("friction", 0.3, [1.0], rate), normal)]));
                assert!(found.is_err(), "{rate} {number} {place}: {found:?}");
            }
        }
    }
}

#[test]
fn the_errors_read_as_sentences() {
    let (scene, contact) = ("Ladder", "friction on x");
    let none = MotionError::NoMotion { scene, contact, t: None };
    let expected = "no acceleration of Ladder satisfies the law of friction on x: reduce the friction or give a given \
                    limit";
    assert_eq!(none.to_string(), expected);
    let several = MotionError::SeveralMotions { scene, contact, t: Some(2.5) };
    let expected = "several accelerations of Ladder satisfy the law of friction on x at t = 2.5: reduce the friction or \
                    give a given limit";
    assert_eq!(several.to_string(), expected);
    let undecided = MotionError::UndecidedMotion { scene, contact, t: None };
    let expected = "the motion of Ladder was not found, nor shown not to exist, with friction on x: reduce the friction \
                    or the number of contacts at rest";
    assert_eq!(undecided.to_string(), expected);
}
