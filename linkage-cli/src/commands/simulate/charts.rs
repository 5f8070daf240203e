//! The charts of a simulation.

use linkage_dynamics::Scene;
use linkage_report::Table;
use linkage_report::chart::{Chart, Page, Polar, Section};
use linkage_report::table::{Mark, TableError};
use linkage_runtime::Joint;

use super::running::{Running, is_event};
use crate::failure::Failure;
use crate::machine::{Coordinate, Machine};

/// The most curves of a chart.
const MOST_CURVES: usize = 5;

/// The most times of an event that are listed.
const MOST_TIMES: usize = 12;

/// The most dashed lines of a chart: many hide the curves.
const MOST_LINES: usize = 30;

/// The page of a simulation, with the reason why it ended before its end.
pub fn page(machine: &Machine, scene: &Running<'_>, table: &Table, ended: Option<&str>) -> Result<String, Failure> {
    let mut charted = Charted { table, page: Page::new(scene.name(), format!("Simulation of {}", machine.about.name)) };
    charted.about(ended);
    charted.motion(machine)?;
    charted.points(machine)?;
    let outputs = machine.about.outputs.iter().map(|output| vec![output.text.clone()]);
    charted.section("Outputs", outputs)?;
    charted.loads(machine, scene)?;
    let energies = ["kinetic_energy", "potential_energy"].map(str::to_owned).to_vec();
    charted.section("Energy", [energies])?;
    Ok(charted.page.to_html())
}

/// An event with its times.
fn event(name: &str, marks: &[&Mark]) -> String {
    let all: Vec<String> =
        marks.iter().filter(|mark| mark.name == name).map(|mark| format!("{:.6}", mark.at)).collect();
    let more = match all.len().saturating_sub(MOST_TIMES) {
        0 => String::new(),
        more => format!(", and {more} more until {} s", all[all.len() - 1]),
    };
    format!("{name} at {} s{more}.", all[..all.len().min(MOST_TIMES)].join(", "))
}

struct Charted<'t> {
    table: &'t Table,
    page: Page,
}

impl Charted<'_> {
    /// The times and the events.
    fn about(&mut self, ended: Option<&str>) {
        let times = self.table.column("time").unwrap_or_default();
        let (first, last) = (times.first().copied().unwrap_or_default(), times.last().copied().unwrap_or_default());
        let marks: Vec<&Mark> = self.table.marks().iter().filter(|mark| is_event(&mark.name)).collect();
        let section = self.page.section("Events");
        section.lines.push(format!("From {first} s to {last} s."));
        section.lines.extend(ended.map(str::to_owned));
        let mut names: Vec<&str> = Vec::new();
        for mark in &marks {
            if !names.contains(&mark.name.as_str()) {
                names.push(&mark.name);
            }
        }
        section.lines.extend(names.into_iter().map(|name| event(name, &marks)));
    }

    fn motion(&mut self, machine: &Machine) -> Result<(), Failure> {
        let all = || machine.about.inputs.iter().chain(&machine.about.unknowns);
        let named = |is_angle: bool, end: &str| -> Vec<String> {
            let of = all().filter(|of: &&Coordinate| of.is_angle == is_angle);
            of.map(|of| format!("{}{end}", of.name.text)).collect()
        };
        let ends = ["", "_rate", "_acceleration"];
        self.section("Coordinates", ends.into_iter().flat_map(|end| [named(true, end), named(false, end)]))
    }

    fn points(&mut self, machine: &Machine) -> Result<(), Failure> {
        let points = || machine.about.points.iter().map(|point| &point.text);
        let moves = |point: &&String| self.moves(&[format!("{point}_x"), format!("{point}_y")]);
        let moving: Vec<&String> = points().filter(moves).collect();
        let places = moving.iter().map(|point| vec![format!("{point}_x"), format!("{point}_y")]);
        let speeds = moving.iter().map(|point| format!("{point}_speed")).collect();
        self.section("Points", places.chain([speeds]))
    }

    /// True if one of these columns has two numbers.
    fn moves(&self, columns: &[String]) -> bool {
        columns.iter().any(|name| {
            let mut numbers = self.table.column(name).into_iter().flatten().filter(|number| number.is_finite());
            numbers.next().is_some_and(|first| numbers.any(|other| other != first))
        })
    }

    fn loads(&mut self, machine: &Machine, scene: &Running<'_>) -> Result<(), Failure> {
        let drives = machine.about.inputs.iter().map(|input| {
            let end = if input.is_angle { "torque" } else { "force" };
            vec![format!("{}_{end}", input.name.text)]
        });
        self.section("Drives", drives.chain([vec!["drive_power".to_owned()]]))?;
        self.section("Frictions and stops", self.contacts())?;
        let (mut forces, mut moments, mut pins) = (Vec::new(), Vec::new(), Vec::new());
        for joint in scene.joints() {
            match joint {
                Joint::Pin { name, .. } => {
                    forces.push(name.to_owned());
                    pins.push(name);
                }
                Joint::Guide { name, .. } => {
                    forces.push(format!("{name}_normal"));
                    moments.push(format!("{name}_moment"));
                }
            }
        }
        // Forces and moments that are zero have nothing to draw.
        let acts = |name: &String| self.moves(std::slice::from_ref(name));
        let acting = [forces, moments].map(|names| names.into_iter().filter(acts).collect::<Vec<_>>());
        self.section("Forces in joints", acting)?;
        for pin in pins.into_iter().filter(|pin| self.moves(&[(*pin).to_owned()])).collect::<Vec<_>>() {
            match Polar::of(self.table, &format!("{pin}_x"), &format!("{pin}_y")) {
                Ok(chart) => self.last().polar(&chart),
                Err(TableError::NoNumbers { .. }) => {}
                Err(error) => return Err(Failure::Outside(error.to_string())),
            }
        }
        Ok(())
    }

    /// The columns of frictions and stops, by their names.
    fn contacts(&self) -> Vec<Vec<String>> {
        let names = self.table.names().into_iter();
        let is_contact = |name: &&str| ["friction ", "stop ", "contact "].iter().any(|kind| name.starts_with(kind));
        vec![names.filter(is_contact).map(str::to_owned).collect()]
    }

    fn last(&mut self) -> &mut Section {
        let last = self.page.sections.len() - 1;
        &mut self.page.sections[last]
    }

    /// A section with a chart of each of these lists of columns over time, in parts of few curves; none without a column.
    fn section(&mut self, heading: &str, charts: impl IntoIterator<Item = Vec<String>>) -> Result<(), Failure> {
        let known = |name: &String| self.table.column(name).is_some();
        let lists: Vec<Vec<String>> = charts.into_iter().map(|list| list.into_iter().filter(known).collect()).collect();
        let parts: Vec<&[String]> = lists.iter().flat_map(|list| list.chunks(MOST_CURVES)).collect();
        let mut drawn = Vec::new();
        for part in parts {
            match Chart::of(self.table, "time", part) {
                Ok(mut chart) => {
                    if chart.lines.len() > MOST_LINES {
                        chart.lines.clear();
                    }
                    drawn.push(chart);
                }
                // As the loads of a motion that has none.
                Err(TableError::NoNumbers { .. }) => {}
                Err(error) => return Err(Failure::Outside(error.to_string())),
            }
        }
        if !drawn.is_empty() {
            let section = self.page.section(heading);
            drawn.iter().for_each(|chart| section.chart(chart));
        }
        Ok(())
    }
}
