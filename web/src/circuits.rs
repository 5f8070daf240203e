//! The circuits of a mechanism.

use linkage_report::drawing::CircuitChart;
use linkage_report::report::MOST_MODES;
use linkage_runtime::circuits::{CircuitOptions, Circuits, CurveEnd, MotionCurve};
use linkage_runtime::continuation::Options;
use linkage_runtime::{Branches as _, Column, Mechanism as _};
use serde::Serialize;

use crate::Refusal;
use crate::at::{AlongOne, moving, one_input};
use crate::machine::{Machine, prepared};

/// The longest step of a motion in a chart.
const SMOOTH: f64 = 0.1;

/// The most motions that are followed where there are more positions than are listed.
const MOST_MOTIONS: usize = 16;

/// The circuits, and a chart of each unknown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// The number of positions at the inputs.
    positions: usize,
    /// True if others are left out.
    more: bool,
    /// The number of circuits.
    circuits: usize,
    /// The motions, in the order of their numbers in the charts.
    motions: Vec<Motion>,
    charts: Vec<Named>,
}

/// A motion of a circuit.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Motion {
    /// The number of its circuit, from 1.
    circuit: usize,
    least: f64,
    largest: f64,
    way: Way,
    /// The turns of the input after which it is at its start again.
    turns: u32,
}

/// The way of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Way {
    /// The input turns in one direction.
    Turns,
    /// The input goes to and fro.
    ToAndFro,
    /// It ends at ends of ranges.
    Ends,
    /// It does not close.
    Open,
}

/// A chart of an unknown.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Named {
    name: String,
    svg: String,
}

/// The circuits through the positions at these inputs, of which one moves.
pub fn circuits(machine: &Machine, parameters: &[f64], inputs: &[f64], along: usize) -> Result<Found, Refusal> {
    let design = machine.design(parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let Some(&at) = inputs.get(along) else { return Err(Refusal::new("no input moves")) };
    let one = one_input(mechanism, inputs, along)?;
    let options =
        CircuitOptions { path: Options { longest_step: SMOOTH, ..Options::default() }, ..CircuitOptions::default() };
    let refused = |error| Refusal::of_circuits(&machine.about, &error);
    // A list that cannot be made is an error of the circuits too.
    let listed: Vec<_> = match one.all_positions(Column::from([at])) {
        Ok(all) => all.filter(|(_, q)| one.is_within_ranges(q).unwrap_or(false)).take(MOST_MODES + 1).collect(),
        Err(_) => Vec::new(),
    };
    let more = listed.len() > MOST_MODES;
    let found = match listed.get(..MOST_MODES).filter(|_| more) {
        None => Circuits::of(&one, at, options).map_err(refused)?,
        Some(first) => {
            let (found, _, error) = Circuits::of_some(&one, first, MOST_MOTIONS, options);
            match error.filter(|_| found.modes.is_empty()) {
                Some(error) => return Err(refused(error)),
                None => found,
            }
        }
    };
    if let Some(failure) = prepared.failure() {
        return Err(Refusal::new(failure));
    }
    let input = machine.about.inputs.get(along).map_or("", |input| &input.name);
    let charts = machine.about.unknowns.iter().map(|unknown| {
        let chart = CircuitChart::of(&one, &found, &unknown.name).map_err(Refusal::new)?;
        let chart = chart.title(format!("{}({input})", unknown.name)).numbered_from(1);
        Ok(Named { name: unknown.name.clone(), svg: chart.to_svg() })
    });
    let charts = charts.collect::<Result<_, Refusal>>()?;
    let motions = found.motions.iter().enumerate().map(|(place, motion)| {
        let circuit = found.circuits.iter().position(|motions| motions.contains(&place)).unwrap_or_default();
        Motion::of(motion, circuit + 1)
    });
    let motions = motions.collect();
    Ok(Found { positions: found.modes.len(), more, circuits: found.circuits.len(), motions, charts })
}

impl Motion {
    fn of(motion: &MotionCurve<AlongOne, f64, &str>, circuit: usize) -> Self {
        let [least, largest] = motion.range().unwrap_or([f64::NAN; 2]);
        let has_dead_points = motion.dead_points().next().is_some();
        let (way, turns) = match motion.end {
            CurveEnd::Closed { turns } if turns != 0 && !has_dead_points => (Way::Turns, turns.unsigned_abs()),
            CurveEnd::Closed { .. } => (Way::ToAndFro, 0),
            CurveEnd::Limits => (Way::Ends, 0),
            CurveEnd::Open => (Way::Open, 0),
        };
        Self { circuit, least, largest, way, turns }
    }
}
