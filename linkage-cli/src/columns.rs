//! The columns of a table.

use crate::machine::{Coordinate, Named};

/// The endings of the columns of an unknown or an output, and of a point.
pub const ORDERS: [&str; 3] = ["", "_rate", "_acceleration"];
pub const OF_POINT: [&str; 7] =
    ["_x", "_y", "_velocity_x", "_velocity_y", "_speed", "_acceleration_x", "_acceleration_y"];

/// The columns of a position among them.
const STILL: usize = 1;
const STILL_OF_POINT: usize = 2;

/// The names of the columns.
pub fn names(coordinates: [&[Coordinate]; 2], quantities: [&[Named]; 2], is_moving: bool) -> Vec<String> {
    with_ends(coordinates, quantities, is_moving, [&ORDERS, &OF_POINT])
}

/// The names of the columns of a position: none of rates, which are zero without a rate of the input.
pub fn names_at_rest(coordinates: [&[Coordinate]; 2], quantities: [&[Named]; 2]) -> Vec<String> {
    with_ends(coordinates, quantities, false, [&ORDERS[..STILL], &OF_POINT[..STILL_OF_POINT]])
}

fn with_ends(
    [inputs, unknowns]: [&[Coordinate]; 2],
    [points, outputs]: [&[Named]; 2],
    is_moving: bool,
    [orders, of_point]: [&[&str]; 2],
) -> Vec<String> {
    let with =
        |name: &Named, ends: &[&str]| -> Vec<String> { ends.iter().map(|end| format!("{}{end}", name.text)).collect() };
    let time = is_moving.then(|| "time".to_owned());
    let inputs = inputs.iter().map(|input| input.name.text.clone());
    let unknowns = unknowns.iter().flat_map(|unknown| with(&unknown.name, orders));
    let points = points.iter().flat_map(|point| with(point, of_point));
    let outputs = outputs.iter().flat_map(|output| with(output, orders));
    inputs.chain(time).chain(unknowns).chain(points).chain(outputs).collect()
}
