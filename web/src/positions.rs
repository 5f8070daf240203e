//! All positions at given inputs, and the first of a mechanism.

use std::f64::consts::TAU;

use linkage_interpreter::{Data, Design};
use linkage_runtime::position::newton;
use linkage_runtime::{Branches as _, Build as _, Column, Dim as _, Mechanism as _};
use serde::Serialize;

use crate::Refusal;
use crate::at::{Coordinates, Inputs, Moving, inputs_of, moving, place};
use crate::machine::{Machine, prepared};
use crate::picture::drawing;
use crate::question::Place;

/// The angle at which an input begins: every crank can be there.
const BEGIN: f64 = TAU / 6.0;

/// The values of the inputs that are tried, and the guesses at each where positions are not listed.
const MOST_TRIALS: u32 = 96;
const GUESSES: u32 = 8;

/// A position that is listed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Listed {
    branch: String,
    unknowns: Vec<f64>,
    svg: String,
}

/// All positions at these inputs, or the reason why there are none.
pub fn positions(machine: &Machine, parameters: &[f64], inputs: &[f64]) -> Result<Vec<Listed>, Refusal> {
    let design = machine.design(parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let all = mechanism.all_positions(inputs_of(&mechanism, inputs)?).map_err(|error| Refusal::of_position(&error))?;
    let listed = all.map(|(branch, q)| {
        let svg = drawing(&mechanism, &q)?.to_svg().map_err(Refusal::new)?;
        Ok(Listed { branch: branch.to_string(), unknowns: place(&q).unknowns, svg })
    });
    let listed = listed.collect::<Result<Vec<_>, Refusal>>()?;
    match listed.is_empty() {
        true => Err(no_position(&design, inputs)),
        false => Ok(listed),
    }
}

/// The reason why there is no position at these inputs.
fn no_position(design: &Design, inputs: &[f64]) -> Refusal {
    why_not(design, inputs).unwrap_or_else(|| Refusal::new("there is no position at these inputs"))
}

/// The reason why there is no position on the first branch; none if there is one.
pub fn why_not(design: &Design, inputs: &[f64]) -> Option<Refusal> {
    let [sides, modes, turns] = design.mechanism().branch_fields();
    let words = sides.iter().map(|(name, words)| (*name, words.first().copied().map_or(Data::Nothing, Data::from)));
    let numbers = modes.iter().chain(&turns).map(|(name, _)| (*name, Data::Count(0)));
    let given = match inputs {
        [only] => Data::from(*only),
        several => Data::from(several),
    };
    design.call("assemble", &[given, Data::fields(words.chain(numbers))]).err().map(|error| Refusal::of_call(&error))
}

/// A position to begin with: near another one if that is given, else the first at 60 degrees of each input or, if there is none,
/// at the first of other inputs that have one.
pub fn begin(
    machine: &Machine,
    mechanism: &Moving<'_>,
    design: &Design,
    near: Option<&Place>,
) -> Result<Coordinates, Refusal> {
    let v = mechanism.dims().1;
    let size = parameters_size(machine, design.parameters());
    let near = near.filter(|near| near.inputs.len() == v.count());
    let mut first = None;
    if let Some(near) = near {
        match at_inputs(mechanism, inputs_of(mechanism, &near.inputs)?, size, Some(&near.unknowns)) {
            Ok(Some(q)) => return Ok(q),
            Ok(None) => first = Some(no_position(design, &near.inputs)),
            Err(why) => first = Some(why),
        }
    }
    for trial in 0..MOST_TRIALS {
        let inputs: Column<f64, Inputs> = v.column(|input| {
            let is_angle = mechanism.input_angles().get(input).copied().unwrap_or_default();
            if is_angle { BEGIN + TAU * fraction(trial, 2) } else { size * (0.5 + 1.5 * fraction(trial, 2)) }
        });
        match at_inputs(mechanism, inputs, size, None) {
            Ok(Some(q)) => return Ok(q),
            Ok(None) => _ = first.get_or_insert_with(|| no_position(design, inputs.as_slice())),
            Err(why) => _ = first.get_or_insert(why),
        }
    }
    Err(first.unwrap_or_else(|| Refusal::new("no position was found")))
}

/// The position at these inputs that is nearest to these unknowns, or the first from which the mechanism moves.
fn at_inputs(
    mechanism: &Moving<'_>,
    inputs: Column<f64, Inputs>,
    size: f64,
    near: Option<&[f64]>,
) -> Result<Option<Coordinates>, Refusal> {
    let (u, ..) = mechanism.dims();
    let found: Vec<Coordinates> = match mechanism.all_positions(inputs) {
        Ok(all) => all.map(|(_, q)| q).collect(),
        Err(error) => {
            let guesses = (0..GUESSES).map(|guess| {
                let unknowns = u.column(|unknown| {
                    let is_angle = mechanism.unknown_angles().get(unknown).copied().unwrap_or_default();
                    let part = fraction(guess * 7 + 1, [2, 3, 5, 7, 11, 13][unknown % 6]);
                    if is_angle { TAU * part } else { size * (0.25 + part) }
                });
                newton(mechanism, &Coordinates { unknowns, inputs }).map(|found| found.coordinates)
            });
            let found: Vec<Coordinates> = guesses.flatten().take(1).collect();
            if found.is_empty() {
                return Err(Refusal::of_position(&error));
            }
            found
        }
    };
    let is_far = |q: &Coordinates| {
        let each = q.unknowns.iter().zip(near.unwrap_or_default()).zip(mechanism.unknown_angles());
        each.map(
            |((one, other), is_angle)| {
                if *is_angle { ((one - other) / 2.0).sin().abs() } else { (one - other).abs() / size }
            },
        )
        .fold(0.0, f64::max)
    };
    let moves = |q: &&Coordinates| {
        let pose = mechanism.pose_at(q);
        mechanism.is_within_ranges(q).unwrap_or(false)
            && mechanism.block_determinants(&pose).iter().all(|one| *one != 0.0 && one.is_finite())
    };
    Ok(found.iter().filter(moves).min_by(|one, other| is_far(one).total_cmp(&is_far(other))).or(found.first()).copied())
}

/// The lengths of a mechanism: the largest value of a parameter that is no angle, or 1.
fn parameters_size(machine: &Machine, parameters: &[f64]) -> f64 {
    let lengths = machine.about.parameters.iter().zip(parameters).filter(|(about, _)| !about.is_angle);
    let size = lengths.map(|(_, value)| value.abs()).filter(|value| value.is_finite()).fold(0.0, f64::max);
    if size > 0.0 { size } else { 1.0 }
}

/// The digits of a number after the point in reverse order, in a base: parts of 1 that fill it evenly (van der Corput, 1935).
fn fraction(mut number: u32, base: u32) -> f64 {
    let (mut part, mut digit) = (0.0, 1.0 / f64::from(base));
    while number > 0 {
        part += f64::from(number % base) * digit;
        number /= base;
        digit /= f64::from(base);
    }
    part
}
