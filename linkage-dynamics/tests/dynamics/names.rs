//! The functions that emitted code calls take names that are not static, and return them in their errors.

use linkage_dynamics::__rt::{equilibrium, finite_each, not_negative, reduced, validate_contacts, validate_stops};
use linkage_dynamics::{Balance, Contact, ContactCoordinate, ContactLaw, MotionError};
use linkage_runtime::{Column, D};

/// The text of the error.
fn text<P>(result: Result<P, MotionError<&str>>) -> String {
    result.map(|_| ()).expect_err("these arguments are errors").to_string()
}

#[test]
fn names_need_not_be_static() {
    // Dropped before the end of the program.
    let [scene, name] = ["drop", "friction on s"].map(str::to_owned);
    let (scene, name) = (scene.as_str(), name.as_str());
    let not_finite = "friction on s of drop is not a finite number";
    let negative = "friction on s of drop is -1.0: it must be at least 0.0";
    let contact = |limit: f64| {
        let along: ContactCoordinate<f64, D<1>, D<1>> =
            ContactCoordinate { value: 0.0, unknowns: Column::zeros(), inputs: Column::zeros(), bias: 0.0 };
        validate_contacts(scene, [Contact { name, along, law: ContactLaw::Friction { limit } }])
    };
    assert_eq!(text(contact(f64::NAN)), not_finite);
    assert_eq!(text(contact(-1.0)), negative);
    assert_eq!(contact(1.0).map(|[contact]| contact.name), Ok(name));
    assert_eq!(text(finite_each(scene, [(name, f64::NAN)])), not_finite);
    assert_eq!(text(not_negative(scene, [(name, f64::NAN)])), not_finite);
    assert_eq!(text(not_negative(scene, [(name, -1.0)])), negative);
    assert_eq!(not_negative::<f64, _>(scene, []), Ok(()));
    assert_eq!(text(validate_stops(scene, [(name, 0.0, f64::NAN, 0.0)])), not_finite);
    assert!(
        text(validate_stops(scene, [(name, 1.0, 0.0, 0.0)])).starts_with("the friction on s in drop is from 1 to 0")
    );
    assert!(text(validate_stops(scene, [(name, 0.0, 1.0, 2.0)])).starts_with("the restitution of friction on s is 2"));
    assert!(
        text(reduced(scene, [name], [[0.0]], [1.0])).starts_with("the mass matrix of drop is singular in friction")
    );
    let nowhere = |_: [f64; 1]| Ok(((), Balance { forces: [1.0], scales: [1.0], slopes: [[1.0]] }));
    assert!(text(equilibrium(scene, [0.0], nowhere)).starts_with("no position of drop found"));
}
