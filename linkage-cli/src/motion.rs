//! The inputs of a table or a film: one moves, others are held.

use std::f64::consts::TAU;

use crate::arguments::Along;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::names::once;
use crate::values::{Assignment, Value};

/// The values of all inputs at each step.
pub struct Path {
    held: Vec<f64>,
    /// The input that moves.
    pub moving: usize,
    pub ends: [f64; 2],
}

impl Path {
    pub fn of(machine: &Machine, along: &Along) -> Result<Self, Failure> {
        let free =
            || machine.about.inputs.iter().position(|input| along.at.iter().all(|at| at.name != input.name.text));
        let moving = match &along.along {
            Some(name) => machine.input(name)?,
            None => free().ok_or_else(|| Failure::Argument("each input is held: leave out one --at".to_owned()))?,
        };
        let input = &machine.about.inputs[moving];
        let given = |value: &Option<Value>| value.map(|value| input.value(value)).transpose();
        let usual = usual_ends(machine, moving);
        let ends = [given(&along.from)?.or(usual[0]), given(&along.to)?.or(usual[1])];
        let [Some(from), Some(to)] = ends else {
            let missing = match ends {
                [None, None] => "--from and --to",
                [None, _] => "--from",
                _ => "--to",
            };
            return Err(Failure::Argument(format!("`{}` is {}: write {missing}", input.name.text, input.kind())));
        };
        if from == to {
            return Err(Failure::Argument("--from and --to are equal".to_owned()));
        }
        let held = held(machine, &along.at, Some((moving, from)))?;
        Ok(Self { held, moving, ends: [from, to] })
    }

    /// The inputs where the moving one has this value.
    pub fn at(&self, value: f64) -> Vec<f64> {
        let mut inputs = self.held.clone();
        inputs[self.moving] = value;
        inputs
    }

    /// True for one or more whole turns.
    pub fn is_turn(&self, machine: &Machine) -> bool {
        let [from, to] = self.ends;
        machine.about.inputs[self.moving].is_angle && ((to - from) / TAU).fract() == 0.0
    }

    /// The value of the moving input at one of this number of equal steps.
    pub fn step(&self, step: u32, steps: u32) -> f64 {
        let [from, to] = self.ends;
        // Exactly at both ends.
        if step == steps { to } else { from + (to - from) * f64::from(step) / f64::from(steps) }
    }
}

/// The first and the last value of an input that moves: the ends of its declared range, of an angle without two ends a turn
/// from the one that it has, or from 0.
pub fn usual_ends(machine: &Machine, input: usize) -> [Option<f64>; 2] {
    match (machine.declared(input), machine.about.inputs[input].is_angle) {
        ([None, None], true) => [Some(0.0), Some(TAU)],
        ([Some(least), None], true) => [Some(least), Some(least + TAU)],
        ([None, Some(most)], true) => [Some(most - TAU), Some(most)],
        (ends, _) => ends,
    }
}

/// The inputs with these values, and the first value of the one that moves; those without one are held at their first value.
pub fn held(machine: &Machine, at: &[Assignment], moving: Option<(usize, f64)>) -> Result<Vec<f64>, Failure> {
    let mut inputs: Vec<Option<f64>> =
        (0..machine.about.inputs.len()).map(|input| machine.first_value(input)).collect();
    once("--at", at.iter().map(|at| at.name.as_str()))?;
    for Assignment { name, value } in at {
        let place = machine.input(name)?;
        inputs[place] = Some(machine.about.inputs[place].value(*value)?);
    }
    if let Some((moving, first)) = moving {
        inputs[moving] = Some(first);
    }
    let each = machine.about.inputs.iter().zip(inputs).map(|(input, value)| {
        let name = &input.name.text;
        value.ok_or_else(|| Failure::Argument(format!("the input `{name}` has no value: write --at {name}=VALUE")))
    });
    each.collect()
}
