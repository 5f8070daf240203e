//! `linkage circuits`: the positions that are connected by motion.

use linkage_interpreter::BranchAtRunTime;
use linkage_report::drawing::CircuitChart;
use linkage_report::report::MOST_MODES;
use linkage_runtime::circuits::{self, CircuitError, CircuitOptions};
use linkage_runtime::continuation::Options;
use linkage_runtime::{Branches as _, Column, Mechanism, PositionError};
use serde::Serialize;

use super::draw::undrawn;
use super::list::{moving, to_json};
use crate::arguments::{self, CircuitsFormat};
use crate::curve::{Event, Motion};
use crate::ends::shown;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::motion::{held, usual_ends};
use crate::names::place;
use crate::one_input::{At, OneInput, one_input, prepared};
use crate::output::{self, Form, form};
use crate::progress;
use crate::terminal::say;

/// The place of a start within its part of the range, the golden section: mechanisms are rarely singular there.
const WITHIN: f64 = 0.381_966_011_250_105;

/// The longest step of a curve in a chart, in the units of a path: it looks smooth.
const SMOOTH: f64 = 1.0 / 16.0;

/// The most motions that are followed where there are many positions.
const MOST_MOTIONS: usize = 16;

const FORMS: [Form; 4] = [("text", &["txt"]), ("JSON", &["json"]), ("HTML", &["html", "htm"]), ("SVG", &["svg"])];

/// The formats of these forms.
const FORMATS: [CircuitsFormat; 4] =
    [CircuitsFormat::Text, CircuitsFormat::Json, CircuitsFormat::Html, CircuitsFormat::Svg];

type Found<'p> = circuits::Circuits<At, BranchAtRunTime<'p>, f64, &'p str>;

pub fn run(arguments: &arguments::Circuits) -> Result<(), Failure> {
    let arguments::Circuits { numbers, at, along, output, .. } = arguments;
    let of_ending = form(output, "a list of circuits", &FORMS)?.map(|place| FORMATS[place]);
    let format = arguments.format.or(of_ending).unwrap_or(CircuitsFormat::Text);
    let (machine, ()) = &Machine::of_all(numbers, |_| ())?;
    let charted = charted(machine, &arguments.chart, format)?;
    let moving = moving(machine, along.as_deref())?;
    let starts = starts(machine, moving, arguments)?;
    let first = starts.first().copied().unwrap_or_default();
    let given = at.iter().any(|at| at.name == machine.about.inputs[moving].name.text);
    let inputs = held(machine, at, (!given).then_some((moving, first)))?;
    let prepared = prepared(machine)?;
    let mechanism = one_input(&prepared, &inputs, moving)?;
    let still = vec![0.0; inputs.len()];
    let chosen = match numbers.choose() && machine.solver.has_many_branches() {
        true => Some(machine.place(&inputs, &still).map_err(Failure::Outside)?),
        false => None,
    };
    let found = progress::during("following".to_owned(), || {
        let path = match charted.as_slice() {
            [] => Options::default(),
            _ => Options { longest_step: SMOOTH, ..Options::default() },
        };
        let options = CircuitOptions { path, ..CircuitOptions::default() };
        match machine.solver.has_many_branches() {
            false => Found::over(&mechanism, starts.iter().copied(), options),
            true => some(&mechanism, first, chosen.as_deref(), options),
        }
    });
    if let Some(failure) = prepared.failure() {
        return Err(Failure::Outside(failure.to_string()));
    }
    let found = found.map_err(|error| match error {
        CircuitError::Path { mode, error } => {
            let other = if given { "--at" } else { "--starts" };
            Failure::Outside(format!(
                "from position {}, {}: write another {other}",
                mode + 1,
                machine.about.reasons.of_path(&error)
            ))
        }
        other => Failure::Outside(other.to_string()),
    })?;
    if found.modes.is_empty() {
        return Err(Failure::Outside(none(machine, &inputs, starts.len())));
    }
    let found = match numbers.choose() && chosen.is_none() {
        true => circuit_of_chosen(machine, &inputs, moving, found)?,
        false => found,
    };
    let list = Circuits::of(machine, &inputs, moving, &found)?;
    let charts = charted.iter().map(|unknown| {
        let chart = CircuitChart::of(&mechanism, &found, unknown).map_err(undrawn)?;
        Ok(chart.title(format!("{unknown} over {}", list.input)).numbered_from(1))
    });
    let charts = charts.collect::<Result<Vec<_>, Failure>>()?;
    let text = match format {
        CircuitsFormat::Text => list.to_text(),
        CircuitsFormat::Json => to_json(&list)?,
        CircuitsFormat::Html => CircuitChart::to_html(&list.mechanism, &charts, &list.to_text()),
        CircuitsFormat::Svg => charts.iter().map(CircuitChart::to_svg).collect(),
    };
    output::write(output, text.as_bytes(), &numbers.source.file)
}

/// The unknowns that the charts of a form have.
fn charted<'m>(machine: &'m Machine, asked: &[String], format: CircuitsFormat) -> Result<Vec<&'m str>, Failure> {
    let names: Vec<&str> = machine.about.unknowns.iter().map(|unknown| unknown.name.text.as_str()).collect();
    let asked = asked.iter().map(|name| Ok(names[place(&machine.about.name, "unknown", name, &names)?]));
    let asked = asked.collect::<Result<Vec<&str>, Failure>>()?;
    match (format, asked.as_slice()) {
        (CircuitsFormat::Text | CircuitsFormat::Json, []) => Ok(Vec::new()),
        (CircuitsFormat::Text | CircuitsFormat::Json, _) => Err(Failure::Argument(
            "charts are HTML or SVG: write -o NAME.html or NAME.svg, or leave out --chart".to_owned(),
        )),
        (_, []) if names.is_empty() => {
            Err(Failure::Outside(format!("`{}` has no unknown that a chart could have", machine.about.name)))
        }
        (CircuitsFormat::Html, []) => Ok(names),
        (CircuitsFormat::Svg, []) => Ok(names.into_iter().take(1).collect()),
        (CircuitsFormat::Svg, [_, _, ..]) => {
            Err(Failure::Argument("a picture has one chart: write one --chart, or -o NAME.html".to_owned()))
        }
        (_, _) => Ok(asked),
    }
}

/// The circuits through the first of many positions at a value of the input, or through the chosen one; it says if others
/// are left out.
fn some<'p>(
    mechanism: &OneInput<'p>,
    input: f64,
    chosen: Option<&[f64]>,
    options: CircuitOptions,
) -> Result<Found<'p>, CircuitError<&'p str>> {
    let mut listed = Vec::new();
    for (branch, position) in mechanism.all_positions(Column::from([input]))? {
        if mechanism.is_within_ranges(&position).map_err(PositionError::from)? {
            listed.push((branch, position));
        }
    }
    if let Some(unknowns) = chosen {
        let off = |(_, position): &(_, At)| off(mechanism.unknown_angles(), position, unknowns);
        let nearest = listed.iter().min_by(|one, other| off(one).total_cmp(&off(other)));
        listed = nearest.copied().into_iter().collect();
    }
    listed.truncate(MOST_MODES);
    let (found, _, error) = Found::of_some(mechanism, &listed, MOST_MOTIONS, options);
    match error.filter(|_| found.modes.is_empty()) {
        Some(error) => Err(error),
        None if chosen.is_some() => Ok(found),
        None => {
            let count = found.motions.len();
            say!("there are many positions: these are the circuits of {count} motions, others are left out");
            Ok(found)
        }
    }
}

/// The largest difference of a position from unknowns, whole turns of angles aside.
fn off(are_angles: &[bool], position: &At, unknowns: &[f64]) -> f64 {
    let listed = OneInput::unknowns(position);
    let each = listed.iter().zip(unknowns).zip(are_angles);
    each.map(|((one, other), is_angle)| if *is_angle { ((one - other) / 2.0).sin() } else { one - other })
        .fold(0.0, |most: f64, off| most.max(off.abs()))
}

/// The circuit of the position that the branch or the guess chooses at the first value that has one.
fn circuit_of_chosen<'p>(
    machine: &Machine,
    inputs: &[f64],
    moving: usize,
    found: Found<'p>,
) -> Result<Found<'p>, Failure> {
    let (still, mut why) = (vec![0.0; inputs.len()], None);
    let chosen = found.modes.iter().map(|mode| mode.position.parameter).find_map(|value| {
        let mut here = inputs.to_vec();
        here[moving] = value;
        match machine.place(&here, &still) {
            Ok(unknowns) => Some((value, unknowns)),
            Err(error) => {
                why.get_or_insert(error);
                None
            }
        }
    });
    let Some((value, unknowns)) = chosen else { return Err(Failure::Outside(why.unwrap_or_default())) };
    let are_angles: Vec<bool> = machine.about.unknowns.iter().map(|of| of.is_angle).collect();
    let off = |mode: &circuits::CircuitMode<At, BranchAtRunTime<'p>>| off(&are_angles, &mode.position, &unknowns);
    let there = found.modes.iter().filter(|mode| mode.position.parameter == value);
    let nearest = there.min_by(|one, other| off(one).total_cmp(&off(other)));
    let circuit = nearest.and_then(|mode| found.circuit_of(mode.motion)).unwrap_or_default();
    Ok(found.only(circuit))
}

/// The reason why there is no position.
fn none(machine: &Machine, inputs: &[f64], starts: usize) -> String {
    match machine.motion(inputs, &vec![0.0; inputs.len()]).err() {
        Some(why) if starts == 1 => why,
        _ => format!("`{}` has no position at any of {starts} values of its input", machine.about.name),
    }
}

/// The values of the moving input at which positions are listed.
fn starts(machine: &Machine, moving: usize, arguments: &arguments::Circuits) -> Result<Vec<f64>, Failure> {
    let arguments::Circuits { at, from, to, starts, .. } = arguments;
    let input = &machine.about.inputs[moving];
    let name = &input.name.text;
    let wrong = |message: String| Err(Failure::Argument(message));
    if let Some(at) = at.iter().find(|at| at.name == *name) {
        return match from.or(*to) {
            Some(_) => wrong(format!("--at {name} is one value, and --from and --to a range: leave out one")),
            None => Ok(vec![input.value(at.value)?]),
        };
    }
    let usual = usual_ends(machine, moving);
    let given = [from, to].map(|end| end.map(|value| input.value(value)).transpose());
    let [given_from, given_to] = given;
    let ends = [given_from?.or(usual[0]), given_to?.or(usual[1])];
    let [Some(from), Some(to)] = ends else {
        return wrong(format!("`{name}` is {}: write --at {name}=VALUE, or --from and --to", input.kind()));
    };
    if from >= to {
        return wrong("--from is less than --to".to_owned());
    }
    let part = (to - from) / f64::from(*starts);
    Ok((0..*starts).map(|start| from + (f64::from(start) + WITHIN) * part).collect())
}

/// The circuits of a mechanism.
#[derive(Serialize)]
struct Circuits {
    mechanism: String,
    input: String,
    is_angle: bool,
    /// The inputs that are held, in words.
    #[serde(skip)]
    held: String,
    /// The values of all inputs; that of the moving one is the first at which positions were listed.
    inputs: Vec<f64>,
    positions: Vec<Position>,
    motions: Vec<Motion>,
    /// The motions of each circuit, by number from 1.
    circuits: Vec<Vec<usize>>,
}

/// A position that was listed.
#[derive(Serialize)]
struct Position {
    input: f64,
    branch: String,
    unknowns: Vec<f64>,
    /// Its motion, by number from 1.
    motion: usize,
}

impl Circuits {
    fn of(machine: &Machine, inputs: &[f64], moving: usize, found: &Found<'_>) -> Result<Self, Failure> {
        let position = |mode: &circuits::CircuitMode<At, BranchAtRunTime<'_>>| {
            let input = mode.position.parameter;
            let unknowns: Vec<f64> = OneInput::unknowns(&mode.position).iter().copied().collect();
            Position { input, branch: mode.branch.to_string(), unknowns, motion: mode.motion + 1 }
        };
        let motion = |motion| {
            Motion::of(motion).where_singular(|input, unknowns| {
                let mut here = inputs.to_vec();
                here[moving] = input;
                machine.singular(&here, unknowns)
            })
        };
        let input = &machine.about.inputs[moving];
        let others = machine.about.inputs.iter().zip(inputs).enumerate().filter(|(place, _)| *place != moving);
        let held = others.map(|(_, (of, value))| format!("{} = {}", of.name.text, shown(*value, of.is_angle)));
        Ok(Self {
            mechanism: machine.about.name.clone(),
            input: input.name.text.clone(),
            is_angle: input.is_angle,
            held: held.collect::<Vec<_>>().join(", "),
            inputs: inputs.to_vec(),
            positions: found.modes.iter().map(position).collect(),
            motions: found.motions.iter().map(motion).collect::<Result<_, Failure>>()?,
            circuits: found.circuits.iter().map(|motions| motions.iter().map(|motion| motion + 1).collect()).collect(),
        })
    }

    fn to_text(&self) -> String {
        let count = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
        let held = if self.held.is_empty() { String::new() } else { format!(" with {}", self.held) };
        let mut text = format!(
            "{}{held}: {}, {}, {}\n",
            self.mechanism,
            count(self.positions.len(), "position"),
            count(self.motions.len(), "motion"),
            count(self.circuits.len(), "circuit")
        );
        text += "\npositions\n";
        let number = self.positions.len().to_string().len();
        for (place, position) in self.positions.iter().enumerate() {
            let at = format!("{} = {}", self.input, shown(position.input, self.is_angle));
            let branch = if position.branch.is_empty() { String::new() } else { format!(", {}", position.branch) };
            text += &format!("  {:number$}  motion {}: {at}{branch}\n", place + 1, position.motion);
        }
        for (place, motion) in self.motions.iter().enumerate() {
            text += &format!("\nmotion {}: {}\n", place + 1, motion.in_words(&self.input, self.is_angle));
            let all = numbers(&motion.positions);
            if !all.is_empty() {
                text += &format!("  passes position{} {all}\n", if motion.positions.len() == 1 { "" } else { "s" });
            }
            motion.events.iter().for_each(|event: &Event| {
                text += &format!("  {}\n", event.in_words(&self.input, self.is_angle));
            });
        }
        text += "\n";
        for (place, motions) in self.circuits.iter().enumerate() {
            let ending = if motions.len() == 1 { "" } else { "s" };
            text += &format!("circuit {}: motion{ending} {}\n", place + 1, numbers(motions));
        }
        text
    }
}

/// Numbers with commas.
fn numbers(all: &[usize]) -> String {
    all.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}
