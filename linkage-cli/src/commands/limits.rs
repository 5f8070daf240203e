//! `linkage limits`: the ends of the motion through each position at one choice of inputs.

use linkage_report::report::MOST_MODES;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOptions};
use serde::Serialize;

use super::list::moving;
use crate::arguments;
use crate::ends::{Reason, shown};
use crate::failure::Failure;
use crate::followed::{Range, ends, passed};
use crate::machine::Machine;
use crate::motion::held;
use crate::one_input::{coordinates, one_input, prepared};
use crate::terminal::say;

pub fn run(arguments: &arguments::Limits) -> Result<(), Failure> {
    let arguments::Limits { numbers, place, along, form } = arguments;
    let format = form.format("a list of limits")?;
    let is_chosen = numbers.choose();
    let (machine, ()) = Machine::of_all(numbers, |_| ())?;
    let moving = moving(&machine, along.as_deref())?;
    let inputs = held(&machine, &place.at, None)?;
    let all = match is_chosen {
        true => {
            let unknowns = machine.place(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?;
            vec![(String::new(), unknowns)]
        }
        false => listed(&machine, &inputs)?,
    };
    let limits = Limits::of(&machine, &inputs, moving, &all)?;
    let mut fails = limits.positions.iter().map(|position| position.fails.as_ref());
    if let Some(Some(why)) = fails.next()
        && fails.all(|why| why.is_some())
    {
        return Err(Failure::Outside(format!("at {}, {why}: write another --at", machine.at(&inputs))));
    }
    form.write(format, &limits, Limits::to_text, &numbers.source.file)
}

/// The first positions at these inputs, each with its branch; how many are left out is said.
pub fn listed(machine: &Machine, inputs: &[f64]) -> Result<Vec<(String, Vec<f64>)>, Failure> {
    let (all, more) = machine.first_positions(inputs, MOST_MODES).map_err(Failure::Outside)?;
    if more > 0 {
        let count = all.len();
        say!("these are the first {count} positions, and up to {more} more are left out: --branch chooses one");
    }
    if all.is_empty() {
        // The reason is that of the position on the first branch.
        let why = machine.motion(inputs, &vec![0.0; inputs.len()]).err();
        return Err(Failure::Outside(why.unwrap_or_else(|| format!("there is no position at {}", machine.at(inputs)))));
    }
    Ok(all.into_iter().map(|(branch, motion)| (branch, motion.unknowns)).collect())
}

/// The limits of an input about positions.
#[derive(Serialize)]
struct Limits {
    mechanism: String,
    /// The inputs of the positions in words.
    #[serde(skip)]
    at: String,
    input: String,
    is_angle: bool,
    /// The values of all inputs.
    inputs: Vec<f64>,
    positions: Vec<Position>,
}

#[derive(Serialize)]
struct Position {
    branch: String,
    unknowns: Vec<f64>,
    /// The ends of the motion; none if it is closed.
    from: Option<End>,
    to: Option<End>,
    /// The turns of the input after which a motion without end is at its start again.
    #[serde(skip_serializing_if = "Option::is_none")]
    closes_after_turns: Option<u32>,
    /// The inputs of the change points that the motion passes.
    change_points: Vec<f64>,
    /// The reason why the motion is not followed.
    #[serde(skip_serializing_if = "Option::is_none")]
    fails: Option<String>,
}

/// An end of a motion.
#[derive(Serialize)]
struct End {
    input: f64,
    #[serde(flatten)]
    reason: Reason,
}

impl Limits {
    fn of(machine: &Machine, inputs: &[f64], moving: usize, all: &[(String, Vec<f64>)]) -> Result<Self, Failure> {
        let prepared = prepared(machine)?;
        let mechanism = one_input(&prepared, inputs, moving)?;
        let position = |(branch, unknowns): &(String, Vec<f64>)| {
            let mut position = Position {
                branch: branch.clone(),
                unknowns: unknowns.clone(),
                from: None,
                to: None,
                closes_after_turns: None,
                change_points: Vec::new(),
                fails: None,
            };
            let start = coordinates(&mechanism, unknowns, inputs[moving])?;
            match Range::of(mechanism, &start, RangeOptions::through_change_points()) {
                Ok(range) => {
                    let [from, to] = range.inputs();
                    let [lower, upper] = match ends(machine, &range) {
                        Ok(ends) => ends,
                        Err(failure) => return Some(Err(failure)),
                    };
                    let end = |input: f64, reason: Option<Reason>| reason.map(|reason| End { input, reason });
                    position.from = end(from, lower);
                    position.to = end(to, upper);
                    if let [_, MotionEnd::Closed { turns }] = range.ends() {
                        position.closes_after_turns = Some(turns);
                    }
                    position.change_points = passed(&range);
                }
                Err(error) => position.fails = Some(machine.about.reasons.of_path(&error)),
            }
            Some(Ok(position))
        };
        let positions = all.iter().filter_map(position).collect::<Result<_, Failure>>()?;
        if let Some(failure) = prepared.failure() {
            return Err(Failure::Outside(failure.to_string()));
        }
        let input = &machine.about.inputs[moving];
        Ok(Self {
            mechanism: machine.about.name.clone(),
            at: machine.at(inputs),
            input: input.name.text.clone(),
            is_angle: input.is_angle,
            inputs: inputs.to_vec(),
            positions,
        })
    }

    fn to_text(&self) -> String {
        let head = format!("{} about {}\n", self.mechanism, self.at);
        let line = |position: &Position| {
            let branch = if position.branch.is_empty() { String::new() } else { format!("{}: ", position.branch) };
            format!("  {branch}{}\n", self.of_position(position))
        };
        std::iter::once(head).chain(self.positions.iter().map(line)).collect()
    }

    /// The limits about a position in words.
    fn of_position(&self, position: &Position) -> String {
        let Self { input, is_angle, .. } = self;
        if let Some(fails) = &position.fails {
            return format!("not followed: {fails}");
        }
        let end = |of: &End| format!("{} ({})", shown(of.input, *is_angle), of.reason.in_words());
        let mut text = match (&position.from, &position.to, position.closes_after_turns) {
            (Some(from), Some(to), _) => format!("{input} from {} to {}", end(from), end(to)),
            (_, _, Some(0 | 1)) => format!("{input} turns without limits"),
            (_, _, Some(turns)) => format!("{input} turns without limits, and the motion repeats after {turns} turns"),
            _ => format!("{input} without limits"),
        };
        if !position.change_points.is_empty() {
            let at: Vec<String> = position.change_points.iter().map(|at| shown(*at, *is_angle)).collect();
            text += &format!(", through change points at {}", at.join(", "));
        }
        text
    }
}
