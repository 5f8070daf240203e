//! The inputs of a table or a film: one moves, others are held.

use std::f64::consts::TAU;

use crate::arguments::Along;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::names::once;
use crate::values::{Assignment, Value};

/// The angle at which an input is held without a value: every crank can be there.
pub const HELD: f64 = TAU / 6.0;

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
        let turn = if input.is_angle { [Some(0.0), Some(TAU)] } else { [None, None] };
        let ends = [given(&along.from)?.or(turn[0]), given(&along.to)?.or(turn[1])];
        let [Some(from), Some(to)] = ends else {
            let name = &input.name.text;
            return Err(Failure::Argument(format!("`{name}` is a length: write --from and --to")));
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

/// The inputs with these values, and the first value of the one that moves; angles without one are held at 60 degrees.
pub fn held(machine: &Machine, at: &[Assignment], moving: Option<(usize, f64)>) -> Result<Vec<f64>, Failure> {
    let mut inputs: Vec<Option<f64>> =
        machine.about.inputs.iter().map(|input| input.is_angle.then_some(HELD)).collect();
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
