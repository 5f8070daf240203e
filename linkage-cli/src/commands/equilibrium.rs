//! `linkage equilibrium`: the position at which the forces of a scene are in equilibrium.

use linkage_interpreter::{CoordinatesAtRunTime, Data};
use linkage_runtime::Column;
use linkage_runtime::continuation::{Along, AlongCoordinates, Line};
use linkage_runtime::range_of_motion::{RangeOfMotion, RangeOptions};
use serde::Serialize;

use crate::arguments;
use crate::ends::shown;
use crate::failure::Failure;
use crate::machine::{Coordinate, Machine};
use crate::motion::held;
use crate::one_input::Inputs;
use crate::scene::{Need, chosen};
use crate::terminal::say;

const NEED: Need = Need { is_met: |scene| scene.has_equilibrium, statement: "equilibrium;" };

pub fn run(arguments: &arguments::Equilibrium) -> Result<(), Failure> {
    let arguments::Equilibrium { numbers, scene, at, time, form } = arguments;
    let format = form.format("a position of equilibrium")?;
    if let Some(what) = time.measures {
        return Err(Failure::Argument(format!("--time is a plain number of seconds, and this is a unit of {what}")));
    }
    let (machine, design) =
        Machine::with_scene(numbers, |about| chosen(&about.name, &about.scenes, scene.as_deref(), &NEED))?;
    let inputs = held(&machine, at, None)?;
    let unknowns = machine.place(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?;
    let all = || machine.about.inputs.iter().chain(&machine.about.unknowns);
    let guess = all().zip(inputs.iter().chain(&unknowns));
    let guess = Data::fields(guess.map(|(of, value)| (of.name.field.as_str(), Data::from(*value))));
    let function = "equilibrium";
    let given = design.arguments(function).map_err(|error| Failure::Outside(error.to_string()))?;
    // A scene without drives and laws of time takes the guess only.
    let of_time = given.len().saturating_sub(1);
    let given: Vec<Data> = std::iter::repeat_n(Data::from(time.number), of_time).chain([guess]).collect();
    let found = design.call(function, &given);
    let found = found.map_err(|error| Failure::Outside(machine.about.reasons.of_error(&error)))?;
    let value = |of: &Coordinate| {
        let value = found.get(&of.name.field).and_then(Data::number);
        value.ok_or_else(|| Failure::Outside(format!("the position has no number `{}`", of.name.text)))
    };
    let from = (inputs.as_slice(), unknowns.as_slice());
    let inputs = machine.about.inputs.iter().map(value).collect::<Result<Vec<f64>, Failure>>()?;
    let unknowns = machine.about.unknowns.iter().map(value).collect::<Result<Vec<f64>, Failure>>()?;
    let on_motion = is_on_motion(&machine, from, (&inputs, &unknowns));
    let start = machine.at(from.0);
    match on_motion {
        Some(true) => {}
        Some(false) => say!(
            "the motion through the position at {start} does not pass this one, which is on another branch or beyond a dead point"
        ),
        None if machine.about.unknowns.is_empty() => {}
        None => say!("it is not known if a motion from the position at {start} passes this one"),
    }
    let outputs = machine.about.outputs.iter().zip(machine.outputs_at(&inputs, &unknowns)?);
    let coordinates = all().zip(inputs.iter().chain(&unknowns));
    let coordinates =
        coordinates.map(|(of, value)| Number { name: of.name.text.clone(), value: *value, is_angle: of.is_angle });
    let outputs = outputs.zip(&machine.about.output_angles).map(|((of, value), angle)| Number {
        name: of.text.clone(),
        value,
        is_angle: angle.is_some(),
    });
    let rest = Rest {
        scene: design.name().to_owned(),
        on_motion,
        coordinates: coordinates.collect(),
        outputs: outputs.collect(),
    };
    form.write(format, &rest, Rest::to_text, &numbers.source.file)
}

/// True if the motion from one position to the inputs of the other, all in a straight line, passes the other, without a dead point
/// between them; several inputs may get there on another way, so that a line that misses it says nothing. Nothing is known of a
/// mechanism that is not followed. Newton's method stays near the first position, but not on its motion.
fn is_on_motion(machine: &Machine, from: (&[f64], &[f64]), to: (&[f64], &[f64])) -> Option<bool> {
    if machine.about.unknowns.is_empty() {
        return None;
    }
    let prepared = machine.solver.design.prepared().ok()?;
    let [first, last] = [from.0, to.0].map(Column::<f64, Inputs>::from_slice);
    let mechanism = Along { mechanism: prepared.with_inputs().ok()?, inputs: Line { from: first?, to: last? } };
    let q = CoordinatesAtRunTime { unknowns: Column::from_slice(from.1)?, inputs: first? };
    let start = AlongCoordinates { q, parameter: 0.0 };
    let range = RangeOfMotion::over(mechanism, &start, [0.0, 1.0], RangeOptions::through_change_points());
    let there = range.ok().and_then(|range| range.at(1.0).ok());
    let is_on = there.is_some_and(|there| machine.are_same(there.unknowns.as_slice(), to.1));
    (prepared.failure().is_none() && (is_on || from.0.len() == 1)).then_some(is_on)
}

/// A position of equilibrium.
#[derive(Serialize)]
struct Rest {
    scene: String,
    /// True if the motion through the position that is asked for passes this one; nothing if that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    on_motion: Option<bool>,
    /// The inputs, then the unknowns.
    coordinates: Vec<Number>,
    outputs: Vec<Number>,
}

#[derive(Serialize)]
struct Number {
    name: String,
    value: f64,
    is_angle: bool,
}

impl Rest {
    fn to_text(&self) -> String {
        let all = || self.coordinates.iter().chain(&self.outputs);
        let width = all().map(|one| one.name.chars().count()).max().unwrap_or_default();
        let lines = all().map(|one| format!("  {:width$}  {}\n", one.name, shown(one.value, one.is_angle)));
        format!("{}: the forces are in equilibrium, stable or not, at\n{}", self.scene, lines.collect::<String>())
    }
}
