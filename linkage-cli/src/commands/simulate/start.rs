//! The start of a simulation: the position and the rates of the inputs.

use linkage_dynamics::prescribed_after;
use linkage_dynamics::simulation::Start;
use linkage_interpreter::CoordinatesAtRunTime;
use linkage_runtime::Column;

use super::running::{Inputs, Running};
use crate::arguments::Simulate;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::names::once;

type StartOf = Start<f64, CoordinatesAtRunTime<Inputs>, Column<f64, Inputs>>;

/// The start with the values and rates that are given, and for driven inputs those of their laws.
pub fn start(machine: &Machine, scene: &Running<'_>, arguments: &Simulate, t: f64) -> Result<StartOf, Failure> {
    let laws = prescribed_after(scene, t);
    let law = |place: usize| laws.as_slice().get(place).copied().flatten();
    let inputs = &machine.about.inputs;
    let first = |place: usize| law(place).map(|law| law.value).or_else(|| machine.first_value(place));
    let mut values: Vec<Option<f64>> = (0..inputs.len()).map(first).collect();
    let mut rates: Vec<f64> = (0..inputs.len()).map(|place| law(place).map_or(0.0, |law| law.rate)).collect();
    for (option, given) in [("--at", &arguments.at), ("--rate", &arguments.rate)] {
        once(option, given.iter().map(|one| one.name.as_str()))?;
    }
    for at in &arguments.at {
        let place = machine.input(&at.name)?;
        values[place] = Some(inputs[place].value(at.value)?);
    }
    for rate in &arguments.rate {
        let place = machine.input(&rate.name)?;
        rates[place] = inputs[place].rate(rate.value)?;
    }
    let values = inputs.iter().zip(values).map(|(input, value)| {
        let name = &input.name.text;
        value.ok_or_else(|| Failure::Argument(format!("the input `{name}` has no value: write --at {name}=VALUE")))
    });
    let values: Vec<f64> = values.collect::<Result<_, _>>()?;
    let unknowns = machine.place(&values, &vec![0.0; values.len()]).map_err(Failure::Outside)?;
    let too_large = || Failure::Outside(format!("`{}` has too many coordinates", machine.about.name));
    let q = CoordinatesAtRunTime {
        unknowns: Column::from_slice(&unknowns).ok_or_else(too_large)?,
        inputs: Column::from_slice(&values).ok_or_else(too_large)?,
    };
    Ok(Start { t, q, input_rates: Column::from_slice(&rates).ok_or_else(too_large)? })
}
