//! A mechanism of which one input moves and the others are held, for the algorithms of the runtime.

use linkage_interpreter::{AtRunTime, CoordinatesAtRunTime, Prepared};
use linkage_runtime::continuation::{Along, AlongCoordinates, InputAt};
use linkage_runtime::{Column, UpTo};

use crate::failure::Failure;
use crate::machine::Machine;

/// The number of inputs.
pub type Inputs = UpTo<3>;

/// The mechanism with its moving input as its only one.
pub type OneInput<'p> = Along<AtRunTime<'p, Inputs>, InputAt<Column<f64, Inputs>>>;

/// The mechanism with all of its inputs.
pub type Followable<'p> = AtRunTime<'p, Inputs>;

/// Its coordinates.
pub type At = AlongCoordinates<CoordinatesAtRunTime<Inputs>>;

/// The design of a machine for the algorithms of the runtime.
pub fn prepared(machine: &Machine) -> Result<Prepared<'_>, Failure> {
    machine.solver.design.prepared().map_err(|error| Failure::Outside(error.to_string()))
}

/// The mechanism with these inputs, of which one moves.
pub fn one_input<'p>(prepared: &'p Prepared<'p>, inputs: &[f64], place: usize) -> Result<OneInput<'p>, Failure> {
    let mechanism = prepared.with_inputs().map_err(|error| Failure::Outside(error.to_string()))?;
    // As many as the mechanism has.
    let held = Column::from_slice(inputs).ok_or_else(|| Failure::Outside("too many inputs".to_owned()))?;
    Ok(Along { mechanism, inputs: InputAt { held, place } })
}

/// The coordinates at a value of the moving input.
pub fn coordinates(mechanism: &OneInput<'_>, unknowns: &[f64], value: f64) -> Option<At> {
    let inputs = mechanism.inputs.held;
    let q = CoordinatesAtRunTime { unknowns: Column::from_slice(unknowns)?, inputs };
    Some(AlongCoordinates { q, parameter: value })
}
