//! All positions at given inputs, and the first of a mechanism.

use std::f64::consts::TAU;

use linkage_interpreter::{Data, Design};
use linkage_report::report::MOST_MODES;
use linkage_runtime::continuation::{AlongCoordinates, Direction, Path};
use linkage_runtime::position::newton;
use linkage_runtime::{Branches as _, Build as _, Column, Dim as _, Mechanism as _};
use serde::Serialize;

use crate::Refusal;
use crate::at::{Coordinates, Inputs, Moving, inputs_of, moving, one_input, place};
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

/// The positions at these inputs, the first of many, and if others are left out; or the reason why there are none.
pub fn positions(machine: &Machine, parameters: &[f64], inputs: &[f64]) -> Result<(Vec<Listed>, bool), Refusal> {
    let design = machine.design(parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let all = mechanism.all_positions(inputs_of(&mechanism, inputs)?).map_err(|error| Refusal::of_position(&error))?;
    let mut first: Vec<_> = all.take(MOST_MODES + 1).collect();
    let more = first.len() > MOST_MODES;
    first.truncate(MOST_MODES);
    let listed = first.into_iter().map(|(branch, q)| {
        let svg = drawing(&mechanism, &q)?.to_svg().map_err(Refusal::new)?;
        Ok(Listed { branch: branch.to_string(), unknowns: place(&q).unknowns, svg })
    });
    let listed = listed.collect::<Result<Vec<_>, Refusal>>()?;
    match listed.is_empty() {
        true => Err(no_position(&design, inputs)),
        false => Ok((listed, more)),
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

/// A position to begin with: near another one if that is given, else at the first value of each input, which is that of its
/// declared range, or 60 degrees, or half of the largest parameter; if there is none, at the first of other inputs that have
/// one. A position from which the mechanism moves comes before one from which it does not.
pub fn begin(
    machine: &Machine,
    mechanism: &Moving<'_>,
    design: &Design,
    near: Option<&Place>,
) -> Result<Coordinates, Refusal> {
    let v = mechanism.dims().1;
    let size = parameters_size(machine, design.parameters());
    let near = near.filter(|near| near.inputs.len() == v.count());
    let (mut first, mut still) = (None, None);
    if let Some(near) = near {
        match at_inputs(mechanism, inputs_of(mechanism, &near.inputs)?, size, Some(&near.unknowns)) {
            Ok(Some((q, true))) => return Ok(q),
            Ok(Some((q, false))) => still = Some(q),
            Ok(None) => first = Some(no_position(design, &near.inputs)),
            Err(why) => first = Some(why),
        }
    }
    for trial in 0..MOST_TRIALS {
        let inputs: Column<f64, Inputs> = v.column(|input| tried(mechanism, input, size, trial));
        match at_inputs(mechanism, inputs, size, None) {
            Ok(Some((q, true))) => return Ok(q),
            Ok(Some((q, false))) => _ = still.get_or_insert(q),
            Ok(None) => _ = first.get_or_insert_with(|| no_position(design, inputs.as_slice())),
            Err(why) => _ = first.get_or_insert(why),
        }
    }
    still.ok_or_else(|| first.unwrap_or_else(|| Refusal::new("no position was found")))
}

/// A value of an input that is tried: all over its declared range, over a turn, or over lengths of both signs.
fn tried(mechanism: &Moving<'_>, input: usize, size: f64, trial: u32) -> f64 {
    let part = fraction(trial, 2);
    let is_angle = mechanism.input_angles().get(input).copied().unwrap_or_default();
    let unit = if is_angle { TAU } else { 2.0 * size };
    let range = mechanism.input_range(input);
    let ends = range.map_or([None; 2], |range| [range.least, range.most]);
    match (range.and_then(|range| range.first()), ends) {
        // From the middle on.
        (Some(first), [Some(least), Some(most)]) => {
            let value = first + (most - least) * part;
            if value > most { value - (most - least) } else { value }
        }
        (Some(least), [Some(_), None]) => least + unit * part,
        (Some(most), [None, Some(_)]) => most - unit * part,
        _ if is_angle => BEGIN + TAU * part,
        // From half of the size up to twice the size; then below, down to less than nothing.
        _ if trial < MOST_TRIALS / 2 => size * (0.5 + 1.5 * part),
        _ => size * (0.5 - 2.5 * fraction(trial - MOST_TRIALS / 2 + 1, 2)),
    }
}

/// The position at these inputs that is nearest to these unknowns, or the first; of those from which the mechanism moves if
/// there are any, which is the other answer.
fn at_inputs(
    mechanism: &Moving<'_>,
    inputs: Column<f64, Inputs>,
    size: f64,
    near: Option<&[f64]>,
) -> Result<Option<(Coordinates, bool)>, Refusal> {
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
    // Within its ranges, and at no dead point or change point.
    let moves = |q: &&Coordinates| {
        (0..inputs.as_slice().len()).any(|place| {
            let start = AlongCoordinates { q: **q, parameter: inputs[place] };
            one_input(*mechanism, inputs.as_slice(), place)
                .is_ok_and(|one| Path::new(one, &start, Direction::Increasing).is_ok())
        })
    };
    let moving = found.iter().filter(moves).min_by(|one, other| is_far(one).total_cmp(&is_far(other)));
    Ok(moving.map(|q| (*q, true)).or_else(|| found.first().map(|q| (*q, false))))
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
