//! The charts of a simulation.

use linkage_dynamics::Scene;
use linkage_runtime::{Joint, Kinematic, Mechanism};

use super::{Chart, Page, Polar, Section};
use crate::Table;
use crate::table::{Mark, TableError, names};

/// The most curves of a chart.
const MOST_CURVES: usize = 5;

/// The most times of an event that are listed.
const MOST_TIMES: usize = 12;

/// The most dashed lines of a chart: many hide the curves.
const MOST_LINES: usize = 30;

impl Page {
    /// The charts of a simulation whose table has these columns, and the reason why it ended before its end.
    ///
    /// # Errors
    /// [`TableError`] of a table that is none of this scene.
    pub fn of_simulation<S>(scene: &S, table: &Table, ended: Option<&str>) -> Result<Self, TableError>
    where
        S: Scene<Scalar = f64>,
        S::Mechanism: Kinematic,
    {
        let mechanism = scene.mechanism();
        let mut charted =
            Charted { table, page: Self::new(scene.name().to_string(), format!("Simulation of {}", mechanism.name())) };
        charted.about(ended);
        charted.motion(mechanism)?;
        charted.points(mechanism)?;
        let outputs = names(|place| mechanism.output_name(place)).map(|output| vec![output]);
        charted.section("Outputs", outputs)?;
        charted.loads(scene)?;
        let energies = ["kinetic_energy", "potential_energy"].map(str::to_owned).to_vec();
        charted.section("Energy", [energies])?;
        Ok(charted.page)
    }
}

/// True for the name of a mark that is more than a kink of a law.
fn is_event(mark: &str) -> bool {
    !mark.starts_with("kink of ")
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

    fn motion<M: Mechanism>(&mut self, mechanism: &M) -> Result<(), TableError> {
        let inputs = (0..).map(|place| mechanism.input_name(place)).zip(mechanism.input_angles());
        let unknowns = (0..).map(|place| mechanism.unknown_name(place)).zip(mechanism.unknown_angles());
        let all: Vec<(String, bool)> =
            inputs.chain(unknowns).map(|(name, is_angle)| (name.to_string(), *is_angle)).collect();
        let named = |are_angles: bool, end: &str| -> Vec<String> {
            let of = all.iter().filter(|(_, is_angle)| *is_angle == are_angles);
            of.map(|(name, _)| format!("{name}{end}")).collect()
        };
        let ends = ["", "_rate", "_acceleration"];
        self.section("Coordinates", ends.into_iter().flat_map(|end| [named(true, end), named(false, end)]))
    }

    fn points<M: Kinematic>(&mut self, mechanism: &M) -> Result<(), TableError> {
        let moves = |point: &String| self.moves(&[format!("{point}_x"), format!("{point}_y")]);
        let moving: Vec<String> = names(|place| mechanism.point_name(place)).filter(moves).collect();
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

    fn loads<S: Scene>(&mut self, scene: &S) -> Result<(), TableError> {
        let mechanism = scene.mechanism();
        let drives = mechanism.input_angles().iter().enumerate().map(|(place, is_angle)| {
            let end = if *is_angle { "torque" } else { "force" };
            vec![format!("{}_{end}", mechanism.input_name(place))]
        });
        self.section("Drives", drives.chain([vec!["drive_power".to_owned()]]))?;
        self.section("Frictions and stops", self.contacts())?;
        let (mut forces, mut moments, mut pins) = (Vec::new(), Vec::new(), Vec::new());
        for joint in scene.joints() {
            match joint {
                Joint::Pin { name, .. } => {
                    forces.push(name.to_string());
                    pins.push(name.to_string());
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
        for pin in pins.into_iter().filter(|pin| self.moves(std::slice::from_ref(pin))).collect::<Vec<_>>() {
            match Polar::of(self.table, &format!("{pin}_x"), &format!("{pin}_y")) {
                Ok(chart) => self.last().polar(&chart),
                Err(TableError::NoNumbers { .. }) => {}
                Err(error) => return Err(error),
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
    fn section(&mut self, heading: &str, charts: impl IntoIterator<Item = Vec<String>>) -> Result<(), TableError> {
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
                Err(error) => return Err(error),
            }
        }
        if !drawn.is_empty() {
            let section = self.page.section(heading);
            drawn.iter().for_each(|chart| section.chart(chart));
        }
        Ok(())
    }
}
