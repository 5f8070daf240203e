//! Positions, velocity ratios and accelerations with 45 digits, and the errors of results.

use std::any::Any;

use linkage::Real;
use linkage_double::DoubleDouble;
use nalgebra::RealField;
use serde_json::Value;

/// Written by `tests/oracle/accuracy.py`.
const VALUES: &str = include_str!("../../tests/oracle/accuracy.json");

/// One pose.
pub struct Case {
    pub parameters: Vec<f64>,
    pub input: f64,
    /// The unknowns, if the angles are given.
    pub unknowns: Vec<f64>,
    /// A nearby input with its unknowns in `f64`.
    pub before: (f64, Vec<f64>),
    /// u, u' and u'', each number as three doubles.
    expected: [Vec<[f64; 3]>; 3],
}

/// Poses of a mechanism with the same conditioning.
pub struct Poses {
    /// `benign` (well conditioned), the sine of the transmission angle, or where the inputs lie: `turn`, `range`.
    pub pose: String,
    /// True if the unknowns are given, false if they follow from the input.
    pub angles_given: bool,
    /// The dead points between which the inputs lie.
    pub dead: Vec<f64>,
    pub cases: Vec<Case>,
}

pub fn poses_of(mechanism: &str) -> Vec<Poses> {
    let values: Value = serde_json::from_str(VALUES).expect("the oracle is JSON");
    let rows = values.as_array().expect("a list").iter().filter(|row| row["mechanism"] == mechanism);
    rows.map(|row| Poses {
        pose: row["pose"].as_str().expect("a name").to_owned(),
        angles_given: row["given"] == "angles",
        dead: row["dead"].as_array().map_or_else(Vec::new, |list| list.iter().filter_map(Value::as_f64).collect()),
        cases: row["cases"].as_array().expect("a list").iter().map(case).collect(),
    })
    .collect()
}

fn case(value: &Value) -> Case {
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let list = |name: &str| value[name].as_array().map_or_else(Vec::new, |list| list.iter().map(number).collect());
    let exact = |name: &str| {
        let numbers = value[name].as_array().map(Vec::as_slice).unwrap_or_default();
        numbers.iter().map(|parts| [0, 1, 2].map(|i| number(&parts[i]))).collect()
    };
    Case {
        parameters: list("parameters"),
        input: number(&value["input"]),
        unknowns: list("unknowns"),
        before: (number(&value["before"]), list("near")),
        expected: [exact("position"), exact("velocity"), exact("acceleration")],
    }
}

impl Case {
    /// The error of the derivative of this order. Position: the largest error of an angle in radians, modulo full
    /// turns. Velocity: the largest error divided by the largest entry. Acceleration: divided by the larger of the
    /// largest entry and the square of the largest velocity, of which it consists.
    pub fn error<T: Real>(&self, order: usize, found: &[T]) -> f64 {
        let expected = &self.expected[order];
        assert_eq!(found.len(), expected.len());
        let mut largest = 0.0_f64;
        for (&found, &[high, middle, low]) in found.iter().zip(expected) {
            let mut error = exactly(found) - DoubleDouble::from(high) - DoubleDouble::from(middle) - low.into();
            if order == 0 {
                let turns = (error.high() / std::f64::consts::TAU).round();
                error -= DoubleDouble::two_pi() * turns.into();
            }
            // `max` would ignore a NaN.
            largest = if error.high().is_nan() { f64::INFINITY } else { largest.max(error.high().abs()) };
        }
        let size = |order: usize| self.expected[order].iter().fold(0.0_f64, |size, parts| size.max(parts[0].abs()));
        match order {
            0 => largest,
            1 => largest / size(1),
            _ => largest / size(2).max(size(1) * size(1)),
        }
    }
}

/// Converts a scalar exactly.
fn exactly<T: Real>(value: T) -> DoubleDouble {
    let value = &value as &dyn Any;
    let single = || value.downcast_ref::<f32>().map(|&value| f64::from(value).into());
    let double = || value.downcast_ref::<f64>().map(|&value| value.into());
    value.downcast_ref().copied().or_else(double).or_else(single).expect("a scalar of the price list")
}
