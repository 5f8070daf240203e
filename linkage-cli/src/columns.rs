//! The columns of a table.

use crate::machine::{Coordinate, Named};

/// The endings of the columns of an unknown or an output, and of a point.
pub const ORDERS: [&str; 3] = ["", "_rate", "_acceleration"];
pub const OF_POINT: [&str; 7] =
    ["_x", "_y", "_velocity_x", "_velocity_y", "_speed", "_acceleration_x", "_acceleration_y"];

/// The endings of rates and accelerations among them.
pub const OF_RATES: [&str; 7] =
    ["_rate", "_acceleration", "_velocity_x", "_velocity_y", "_speed", "_acceleration_x", "_acceleration_y"];

/// The names of the columns.
pub fn names([inputs, unknowns]: [&[Coordinate]; 2], [points, outputs]: [&[Named]; 2], is_moving: bool) -> Vec<String> {
    let with =
        |name: &Named, ends: &[&str]| -> Vec<String> { ends.iter().map(|end| format!("{}{end}", name.text)).collect() };
    let time = is_moving.then(|| "time".to_owned());
    let inputs = inputs.iter().map(|input| input.name.text.clone());
    let unknowns = unknowns.iter().flat_map(|unknown| with(&unknown.name, &ORDERS));
    let points = points.iter().flat_map(|point| with(point, &OF_POINT));
    let outputs = outputs.iter().flat_map(|output| with(output, &ORDERS));
    inputs.chain(time).chain(unknowns).chain(points).chain(outputs).collect()
}
