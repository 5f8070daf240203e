//! The whole motion through a position: its range, its table and its film.

use std::f64::consts::TAU;

use linkage_report::Table;
use linkage_report::chart::Chart;
use linkage_report::drawing::Animation;
use linkage_runtime::Mechanism as _;
use linkage_runtime::continuation::AlongCoordinates;
use linkage_runtime::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use serde::Serialize;

use crate::Refusal;
use crate::about::Quantity;
use crate::at::{coordinates, moving, one_input};
use crate::limit::Limit;
use crate::machine::{Machine, prepared};
use crate::question::At;

/// The most steps of a table.
const MOST_STEPS: u32 = 10_000;

/// A motion that was followed.
pub struct Followed {
    /// The mechanism and the values of its parameters.
    pub of: (usize, Vec<f64>),
    pub along: usize,
    table: Table,
    /// None of a mechanism without a drawing.
    pub film: Option<Animation>,
}

/// The range of a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Range {
    least: f64,
    largest: f64,
    is_angle: bool,
    /// Why it ends at its least and its largest input, if something ends it there; nothing if it turns.
    ends: Vec<Option<Limit>>,
    turns: bool,
    columns: Vec<Quantity>,
}

/// The whole motion of the mechanism through a position.
pub fn motion(machine: &Machine, at: &At, along: usize, rate: f64, steps: u32) -> Result<(Followed, Range), Refusal> {
    let design = machine.design(&at.parameters);
    let prepared = prepared(&design)?;
    let mechanism = moving(&prepared)?;
    let q = coordinates(&mechanism, &at.place)?;
    let Some(&parameter) = at.place.inputs.get(along) else { return Err(Refusal::new("no input moves")) };
    let one = one_input(mechanism, &at.place.inputs, along)?;
    let start = AlongCoordinates { q, parameter };
    let is_angle = mechanism.input_angles().get(along).copied().unwrap_or_default();
    let scale = if is_angle { TAU } else { mechanism.length_scale(&mechanism.pose_at(&q)) };
    let asked = [parameter - scale, parameter + scale];
    let range = RangeOfMotion::over(one, &start, asked, RangeOptions::through_change_points())
        .map_err(|error| Refusal::of_path(&machine.about, &error))?;
    if let Some(failure) = prepared.failure() {
        return Err(Refusal::new(failure));
    }
    let [least, largest] = range.inputs();
    let steps = steps.clamp(1, MOST_STEPS);
    let inputs = (0..=steps).map(|step| {
        if step == steps { largest } else { least + (largest - least) * f64::from(step) / f64::from(steps) }
    });
    let table = Table::over(&range, inputs, rate);
    let film = Animation::over(&range).ok();
    let end = |(end, input)| {
        let limit = limit(end)?;
        Some(match range.at(input) {
            Ok(q) => limit.at(&mechanism, &q),
            Err(_) => limit,
        })
    };
    let ends =
        if range.is_closed() { Vec::new() } else { range.ends().into_iter().zip(range.inputs()).map(end).collect() };
    let table = machine.about.with_angles(table).map_err(Refusal::new)?;
    let column = |name: &str| Quantity { name: name.to_owned(), is_angle: machine.about.is_angle(name) };
    let columns = table.names().into_iter().map(column).collect();
    let about = Range { least, largest, is_angle, ends, turns: range.is_closed(), columns };
    Ok((Followed { of: (at.mechanism, at.parameters.clone()), along, table, film }, about))
}

/// The limit at an end; none if the motion goes on there.
fn limit(end: MotionEnd<&str>) -> Option<Limit> {
    match end {
        MotionEnd::DeadPoint { group } => Some(Limit::DeadPoint { group: group.to_owned() }),
        MotionEnd::ChangePoint { groups } => Some(Limit::ChangePoint { group: groups.first().to_owned() }),
        MotionEnd::JointRange { of, end } => Some(Limit::range(of, end)),
        MotionEnd::Range | MotionEnd::Open | MotionEnd::Closed { .. } => None,
    }
}

impl Followed {
    /// A chart of columns over the input.
    pub fn chart(&self, columns: &[String]) -> Result<String, Refusal> {
        let over = self.table.names().first().map(|name| (*name).to_owned()).unwrap_or_default();
        Chart::of(&self.table, &over, columns).map(|chart| chart.to_svg()).map_err(Refusal::new)
    }

    /// The table.
    pub fn csv(&self) -> String {
        self.table.to_csv()
    }
}
