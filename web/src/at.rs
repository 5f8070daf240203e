//! Positions of a mechanism, as the algorithms of the runtime take them.

use linkage_interpreter::{AtRunTime, CoordinatesAtRunTime, Prepared};
use linkage_runtime::continuation::{Along, AlongCoordinates, InputAt};
use linkage_runtime::{Build as _, Column, Dim, Mechanism as _, UpTo};

use crate::Refusal;
use crate::question::Place;

/// The number of inputs: open chains have several.
pub type Inputs = UpTo<6>;

/// A mechanism with all of its inputs.
pub type Moving<'p> = AtRunTime<'p, Inputs>;

/// Its coordinates.
pub type Coordinates = CoordinatesAtRunTime<Inputs>;

/// A mechanism of which one input moves.
pub type OneInput<'p> = Along<Moving<'p>, InputAt<Column<f64, Inputs>>>;

/// Its coordinates.
pub type AlongOne = AlongCoordinates<Coordinates>;

/// The mechanism with all of its inputs.
pub fn moving<'p>(prepared: &'p Prepared<'p>) -> Result<Moving<'p>, Refusal> {
    prepared.with_inputs().map_err(Refusal::new)
}

/// The mechanism of which one input moves, and the others have these values.
pub fn one_input<'p>(mechanism: Moving<'p>, inputs: &[f64], place: usize) -> Result<OneInput<'p>, Refusal> {
    Ok(Along { mechanism, inputs: InputAt { held: inputs_of(&mechanism, inputs)?, place } })
}

/// Inputs of a mechanism.
pub fn inputs_of(mechanism: &Moving<'_>, inputs: &[f64]) -> Result<Column<f64, Inputs>, Refusal> {
    column(inputs, mechanism.dims().1)
}

/// A position of a mechanism.
pub fn coordinates(mechanism: &Moving<'_>, place: &Place) -> Result<Coordinates, Refusal> {
    let (u, v, _) = mechanism.dims();
    Ok(CoordinatesAtRunTime { unknowns: column(&place.unknowns, u)?, inputs: column(&place.inputs, v)? })
}

/// A position as the page has it.
pub fn place(q: &Coordinates) -> Place {
    Place { inputs: q.inputs.as_slice().to_vec(), unknowns: q.unknowns.as_slice().to_vec() }
}

/// The rates of the inputs of which one moves.
pub fn rates(mechanism: &Moving<'_>, along: usize, rate: f64) -> Column<f64, Inputs> {
    mechanism.dims().1.column(|place| if place == along { rate } else { 0.0 })
}

fn column<R: Dim>(numbers: &[f64], dim: R) -> Result<Column<f64, R>, Refusal> {
    let count = dim.count();
    let found = Column::from_slice(numbers).filter(|_| numbers.len() == count);
    found.ok_or_else(|| Refusal::new(format!("{} numbers were given, and the mechanism has {count}", numbers.len())))
}
