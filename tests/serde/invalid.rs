//! Text that does not fit a type is an error, never a value without meaning.

use linkage::integrate::Tolerance;
use linkage::{Column, D, DoubleDouble, Matrix, Rounded};
use serde::de::DeserializeOwned;
use serde_json::{Value, from_str, from_value, json, to_value};

use crate::{FourBar, FourBarCoordinates, FourBarKinematics, FourBarPose, four_bar};

/// The message of text that cannot be read.
#[track_caller]
fn message<X: DeserializeOwned>(value: Value) -> String {
    match from_value::<X>(value) {
        Ok(_) => panic!("it was read"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn lengths_of_columns() {
    for (entries, found) in [(json!([]), 0), (json!([1.0]), 1), (json!([1.0, 2.0, 3.0]), 3)] {
        let expected = format!("invalid length {found}, expected a sequence of length 2");
        assert_eq!(message::<Column<f64, D<2>>>(entries), expected);
    }
    assert_eq!(message::<Column<f64, D<0>>>(json!([1.0])), "invalid length 1, expected a sequence of length 0");
    let ragged = json!([[1.0, 2.0], [3.0]]);
    assert_eq!(message::<Matrix<f64, D<2>, D<2>>>(ragged), "invalid length 1, expected a sequence of length 2");
}

/// JSON has no NaN and no infinity: they are written as null, and null is no number.
#[test]
fn numbers_that_are_not_finite() {
    let q = FourBarCoordinates { theta2: f64::NAN, theta3: f64::INFINITY, theta4: 0.5 };
    let written = to_value(q).unwrap();
    assert_eq!(written, json!({ "theta2": null, "theta3": null, "theta4": 0.5 }));
    assert!(message::<FourBarCoordinates>(written).contains("null"));
    assert!(from_str::<FourBar>(r#"{ "l1": 1e999 }"#).is_err());
    let infinite = DoubleDouble::from(f64::INFINITY);
    assert!(message::<DoubleDouble>(to_value(infinite).unwrap()).contains("null"));
    // A bound that is not known is none.
    let unknown = to_value(Rounded::unknown(0.5)).unwrap();
    assert_eq!(unknown, json!({ "value": 0.5, "error": null }));
    assert_eq!(serde_json::from_value::<Rounded>(unknown).unwrap().error(), f64::INFINITY);
}

/// The length of a direction is 1, in each type that holds a pose.
#[test]
fn directions_of_poses() {
    let (m, branch) = four_bar();
    let kinematics = m.kinematics(0.3, branch, 1.0, 0.0).unwrap();
    let pose = to_value(kinematics.pose).unwrap();
    let directions: Vec<String> =
        pose.as_object().unwrap().iter().filter(|(_, value)| value.is_array()).map(|(name, _)| name.clone()).collect();
    assert!(!directions.is_empty(), "{pose}");
    for name in directions {
        for factor in [0.0, 1.0 - 1e-6, 1.0 + 1e-6, -2.0] {
            let mut changed = pose.clone();
            for part in changed[&name].as_array_mut().unwrap() {
                *part = json!(part.as_f64().unwrap() * factor);
            }
            let expected = "a direction (cos, sin) has a modulus other than 1";
            assert_eq!(message::<FourBarPose>(changed.clone()), expected, "{name}");
            let mut whole = to_value(kinematics).unwrap();
            whole["pose"] = changed;
            assert_eq!(message::<FourBarKinematics>(whole), expected, "{name}");
        }
    }
}

/// Types whose constructor checks its arguments check them when they are read.
#[test]
fn invariants() {
    let tolerance = to_value(Tolerance::<f64, D<1>>::new(1e-9, [1.0]).unwrap()).unwrap();
    for (field, value) in [("relative", json!(0.0)), ("relative", json!(2.0)), ("scale", json!([-1.0]))] {
        let mut changed = tolerance.clone();
        changed[field] = value;
        assert!(message::<Tolerance<f64, D<1>>>(changed).contains("must be"), "{field}");
    }
    let third = to_value(DoubleDouble::from(1.0) / DoubleDouble::from(3.0)).unwrap();
    let mut changed = third.clone();
    changed["low"] = json!(0.1);
    assert_eq!(message::<DoubleDouble>(changed), "`high` is not the double nearest to `high + low`");
    let negative = json!({ "value": 0.5, "error": -1.0 });
    assert_eq!(message::<Rounded>(negative), "`error` is negative or not a number");
}
