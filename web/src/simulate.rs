//! The motion of a scene in time.

use linkage_dynamics::simulation::{Start, simulate as begin};
use linkage_dynamics::{Scene as _, prescribed_after};
use linkage_interpreter::SceneAtRunTime;
use linkage_report::Table;
use linkage_report::chart::Page;
use linkage_report::table::Cause;
use linkage_runtime::Mechanism as _;
use serde::Serialize;

use crate::Refusal;
use crate::at::{Inputs, coordinates, inputs_of};
use crate::follow::drive;
use crate::machine::Machine;
use crate::question::{Place, Simulate};

/// The most steps of a table.
const MOST_STEPS: u32 = 20_000;

/// A simulation for the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Simulated {
    lines: Vec<String>,
    sections: Vec<Section>,
    times: Vec<f64>,
    places: Vec<Place>,
    csv: String,
}

/// Charts under a heading.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Section {
    heading: String,
    charts: Vec<String>,
}

/// Simulates a scene, and says how far it is, from 0 to 1.
pub fn simulate(machine: &Machine, asked: &Simulate, progress: &mut dyn FnMut(f64)) -> Result<Simulated, Refusal> {
    let design = machine.design(&asked.at.parameters);
    let about = machine.about.scenes.get(asked.scene).ok_or_else(|| Refusal::new("there is no such scene"))?;
    let scene = design.scene(&about.name).map_err(Refusal::new)?.with_parameters(&asked.values);
    let prepared = scene.prepared().map_err(Refusal::new)?;
    let scene: SceneAtRunTime<'_, Inputs> = prepared.with_inputs().map_err(Refusal::new)?;
    let (place, rates) = start(&scene, asked)?;
    let q = coordinates(scene.mechanism(), &place)?;
    let start = Start { t: 0.0, q, input_rates: inputs_of(scene.mechanism(), &rates)? };
    let mut simulation =
        begin(&scene, start, asked.to, asked.tolerance).map_err(|error| Refusal::of_motion(&machine.about, &error))?;
    let steps = asked.steps.clamp(1, MOST_STEPS);
    let times = (0..=steps).map(|step| {
        progress(f64::from(step) / f64::from(steps));
        if step == steps { asked.to } else { asked.to * f64::from(step) / f64::from(steps) }
    });
    let table = machine.about.with_angles(Table::simulated_at(&mut simulation, times)).map_err(Refusal::new)?;
    if let Some(failure) = prepared.failure() {
        return Err(Refusal::new(failure));
    }
    let reached = simulation.state().t;
    let error = table.missing().iter().rev().find_map(|missing| match &missing.cause {
        Cause::Motion(error) => Some(error),
        _ => None,
    });
    let why = |error| Refusal::of_motion(&machine.about, error).why;
    let ended = error.filter(|_| reached != asked.to);
    let ended = ended.map(|error| format!("the motion ends at {reached:.6} s: {}", why(error)));
    let page = Page::of_simulation(&scene, &table, ended.as_deref()).map_err(Refusal::new)?;
    let mut lines = Vec::new();
    let mut sections = Vec::new();
    for section in &page.sections {
        lines.extend(section.lines.iter().cloned());
        let charts = section.to_svgs();
        if !charts.is_empty() {
            sections.push(Section { heading: section.heading.clone(), charts });
        }
    }
    let (times, places) = frames(machine, &table);
    Ok(Simulated { lines, sections, times, places, csv: table.to_csv() })
}

/// The position and the rates at the start: inputs with a law have its value and its rate, to which the motion is followed.
fn start(scene: &SceneAtRunTime<'_, Inputs>, asked: &Simulate) -> Result<(Place, Vec<f64>), Refusal> {
    let laws = prescribed_after(scene, 0.0);
    let mut inputs = asked.at.place.inputs.clone();
    let mut rates = asked.rates.clone();
    rates.resize(inputs.len(), 0.0);
    for (place, law) in laws.iter().enumerate().filter_map(|(place, law)| Some((place, (*law)?))) {
        if let (Some(input), Some(rate)) = (inputs.get_mut(place), rates.get_mut(place)) {
            (*input, *rate) = (law.value, law.rate);
        }
    }
    match drive(scene.mechanism(), &asked.at.place, &inputs)? {
        (place, None) => Ok((place, rates)),
        (reached, Some(_)) => {
            let named = |values: &[f64]| -> String {
                let each = values.iter().enumerate();
                let each = each.map(|(place, value)| format!("{} = {value:.6}", scene.mechanism().input_name(place)));
                each.collect::<Vec<_>>().join(", ")
            };
            let (from, stop) = (named(&inputs), named(&reached.inputs));
            Err(Refusal::new(format!(
                "the laws of the scene begin at {from}; the motion to this position stops at {stop}"
            )))
        }
    }
}

/// The times, and the positions at them.
fn frames(machine: &Machine, table: &Table) -> (Vec<f64>, Vec<Place>) {
    let columns = |all: &[crate::about::Quantity]| -> Vec<&[f64]> {
        all.iter().map(|quantity| table.column(&quantity.name).unwrap_or_default()).collect()
    };
    let [inputs, unknowns] = [columns(&machine.about.inputs), columns(&machine.about.unknowns)];
    let row = |columns: &[&[f64]], row: usize| -> Option<Vec<f64>> {
        columns.iter().map(|column| column.get(row).copied().filter(|number| number.is_finite())).collect()
    };
    let times = table.column("time").unwrap_or_default().iter().enumerate();
    let frames = times.filter_map(|(place, time)| {
        Some((*time, Place { inputs: row(&inputs, place)?, unknowns: row(&unknowns, place)? }))
    });
    frames.unzip()
}
