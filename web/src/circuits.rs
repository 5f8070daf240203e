//! The circuits of a mechanism.

use linkage_report::drawing::CircuitChart;
use linkage_runtime::circuits::{CircuitOptions, Circuits, CurveEnd, MotionCurve};
use linkage_runtime::continuation::Options;
use serde::Serialize;

use crate::Refusal;
use crate::at::{AlongOne, moving, one_input};
use crate::machine::{Machine, prepared};

/// The longest step of a motion in a chart.
const SMOOTH: f64 = 0.1;

/// The circuits in words, and a chart of each unknown.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    text: String,
    charts: Vec<Named>,
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
    let found = Circuits::of(&one, at, options).map_err(Refusal::new)?;
    if let Some(failure) = prepared.failure() {
        return Err(Refusal::new(failure));
    }
    let input = machine.about.inputs.get(along).map_or("", |input| &input.name);
    let charts = machine.about.unknowns.iter().map(|unknown| {
        let chart = CircuitChart::of(&one, &found, &unknown.name).map_err(Refusal::new)?;
        let chart = chart.title(format!("{} over {input}", unknown.name)).numbered_from(1);
        Ok(Named { name: unknown.name.clone(), svg: chart.to_svg() })
    });
    let charts = charts.collect::<Result<_, Refusal>>()?;
    let is_angle = machine.about.inputs.get(along).is_some_and(|input| input.is_angle);
    let motions = found.motions.iter().zip(1..).map(|(motion, number)| {
        let circuit = found.circuits.iter().position(|motions| motions.contains(&(number - 1))).unwrap_or_default();
        format!("motion {number}, circuit {}: {}\n", circuit + 1, words(motion, input, is_angle))
    });
    let count = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
    let head = [
        count(found.modes.len(), "position"),
        count(found.motions.len(), "motion"),
        count(found.circuits.len(), "circuit"),
    ];
    Ok(Found { text: format!("{}\n{}", head.join(", "), motions.collect::<String>()), charts })
}

/// The range of a motion in words.
fn words(motion: &MotionCurve<AlongOne, f64, &str>, input: &str, is_angle: bool) -> String {
    let shown = |value: f64| if is_angle { format!("{:.4}°", value.to_degrees()) } else { format!("{value:.6}") };
    let [least, largest] = motion.range().unwrap_or([f64::NAN; 2]).map(shown);
    let has_dead_points = motion.dead_points().next().is_some();
    match motion.end {
        CurveEnd::Closed { turns } if turns != 0 && !has_dead_points => match turns.unsigned_abs() {
            1 => format!("{input} turns fully"),
            turns => format!("{input} turns fully; the motion closes after {turns} turns"),
        },
        CurveEnd::Closed { .. } => format!("{input} goes to and fro between {least} and {largest}"),
        CurveEnd::Limits => format!("{input} from {least} to {largest}, at the ends of ranges"),
        CurveEnd::Open => format!("{input} from {least} to {largest} and on: the motion does not close"),
    }
}
