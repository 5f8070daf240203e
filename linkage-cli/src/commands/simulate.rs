//! `linkage simulate`: the motion of a scene in time.

mod running;
mod start;

use linkage_dynamics::MotionError;
use linkage_dynamics::simulation::{Simulation, simulate};
use linkage_interpreter::PreparedScene;
use linkage_report::Table;
use linkage_report::chart::Page;
use linkage_report::table::{Cause, Mark};
use linkage_runtime::BorrowedName;

use super::summary::Summary;
use super::table::{FOR_READERS, asked, with_units, written};
use crate::arguments::{self, SimulationFormat, TableFormat};
use crate::failure::Failure;
use crate::machine::Machine;
use crate::output::{self, Form, form};
use crate::progress;
use crate::reasons::Reasons;
use crate::said::say_jumps;
use crate::scene::{Need, chosen};
use crate::terminal::say;
use running::{Running, is_event};
use start::start;

const NEED: Need = Need { is_met: |scene| scene.has_inertia, statement: "inertia;" };

/// The most events that are named on standard error.
const NAMED: usize = 10;

pub fn run(arguments: &arguments::Simulate) -> Result<(), Failure> {
    let format = format(arguments)?;
    let [from, to] = times(arguments)?;
    let tolerance = arguments.tolerance.number;
    let (machine, design) = Machine::with_scene(&arguments.numbers, |about| {
        chosen(&about.name, &about.scenes, arguments.scene.as_deref(), &NEED)
    })?;
    let prepared = design.prepared().map_err(|error| Failure::Outside(error.to_string()))?;
    let scene: Running<'_> = prepared.with_inputs().map_err(|error| Failure::Outside(error.to_string()))?;
    let start = start(&machine, &scene, arguments, from)?;
    let mut simulation =
        simulate(&scene, start, to, tolerance).map_err(|error| outside(&machine, &prepared, &error))?;
    simulation = simulation.most_steps(arguments.most_steps as usize);
    // The columns are known, and names that do not exist are found, before the work.
    let all = Table::simulated_at(&mut simulation, []);
    let asked = asked(&all.names().into_iter().map(str::to_owned).collect::<Vec<_>>(), &arguments.shown.columns)?;
    let table = progress::during(format!("simulating {}", design.name()), || match arguments.own_steps {
        true => Table::simulated(&mut simulation),
        false => {
            let steps = arguments.steps;
            let time = |step| if step == steps { to } else { from + (to - from) * f64::from(step) / f64::from(steps) };
            Table::simulated_at(&mut simulation, (0..=steps).map(time))
        }
    });
    if let Some(failure) = prepared.failure() {
        return Err(Failure::Outside(failure.to_string()));
    }
    let table = with_turns(&machine, table)?;
    let reasons = &machine.about.reasons;
    let (marks, ended) = (table.marks().to_vec(), ended(reasons, &simulation, &table, to));
    let incomplete = if ended.is_none() { incomplete(reasons, &table) } else { None };
    let digits = arguments.shown.digits.or((format == SimulationFormat::Text).then_some(FOR_READERS));
    let table = with_units(&machine, table, arguments.shown.degrees)?;
    let text = match (arguments.shown.summary, format.as_table()) {
        (_, None) => {
            let page = Page::of_simulation(&scene, &table, ended.as_deref());
            page.map_err(|error| Failure::Outside(error.to_string()))?.to_html()
        }
        (true, Some(format)) => {
            let units = with_units(&machine, all, arguments.shown.degrees)?;
            let moving = || table.names().into_iter().filter(|name| *name != "time").map(str::to_owned).collect();
            let names = if asked.is_empty() { moving() } else { asked.clone() };
            Summary::of(&table, &units, "time", &names)?.to_text(format, digits)?
        }
        (false, Some(format)) => written(table, &asked, digits, format)?,
    };
    output::write(&arguments.output, text.as_bytes(), &arguments.numbers.source.file)?;
    say(&marks);
    incomplete.iter().for_each(|words| say!("{words}"));
    say_jumps(&machine, &asked);
    match ended {
        Some(why) => Err(Failure::Outside(why)),
        None => Ok(()),
    }
}

impl SimulationFormat {
    /// The form of a table; a page is none.
    fn as_table(self) -> Option<TableFormat> {
        match self {
            Self::Csv => Some(TableFormat::Csv),
            Self::Json => Some(TableFormat::Json),
            Self::Text => Some(TableFormat::Text),
            Self::Html => None,
        }
    }
}

/// The form that is asked for, by its name or by the ending of the file.
fn format(arguments: &arguments::Simulate) -> Result<SimulationFormat, Failure> {
    use SimulationFormat::{Csv, Html, Json, Text};

    let of_place = [Csv, Json, Text, Html];
    let forms: [Form; 4] = [("CSV", &["csv"]), ("JSON", &["json"]), ("text", &["txt"]), ("HTML", &["html", "htm"])];
    let usual = if arguments.shown.summary { Text } else { Csv };
    let of_ending = form(&arguments.output, "a simulation", &forms)?.and_then(|place| of_place.get(place).copied());
    let format = arguments.format.or(of_ending).unwrap_or(usual);
    let given = [("--summary", arguments.shown.summary), ("--columns", !arguments.shown.columns.is_empty())];
    match given.into_iter().find(|(_, is_given)| *is_given && format == Html) {
        Some((option, _)) => Err(Failure::Argument(format!("a page has all charts: leave out {option}"))),
        None => Ok(format),
    }
}

/// The first and the last time.
fn times(arguments: &arguments::Simulate) -> Result<[f64; 2], Failure> {
    for (option, value) in [("--from", arguments.from), ("--to", arguments.to), ("--tolerance", arguments.tolerance)] {
        if let Some(what) = value.measures {
            let message = format!("{option} is a plain number, and this is a unit of {what}");
            return Err(Failure::Argument(message));
        }
    }
    let [from, to] = [arguments.from.number, arguments.to.number];
    match from == to {
        true => Err(Failure::Argument("--from and --to are equal".to_owned())),
        false => Ok([from, to]),
    }
}

/// The table with outputs that go on where their formulas jump.
fn with_turns(machine: &Machine, table: Table) -> Result<Table, Failure> {
    let jumps = machine.about.outputs.iter().zip(&machine.about.output_angles);
    let mut jumps = jumps.filter_map(|(output, angle)| Some((&output.text, (*angle)?.jump?)));
    let found = jumps.try_fold(table, |table, (name, jump)| table.on_turns(name, jump));
    found.map_err(|error| Failure::Argument(error.to_string()))
}

/// The error of a motion; that of damaged code if there is one.
fn outside<N: BorrowedName>(machine: &Machine, prepared: &PreparedScene<'_>, error: &MotionError<N>) -> Failure {
    let why = || machine.about.reasons.of_motion(error);
    Failure::Outside(prepared.failure().map_or_else(why, |failure| failure.to_string()))
}

/// The reason why a simulation has not reached its end.
fn ended(reasons: &Reasons, simulation: &Simulation<'_, Running<'_>>, table: &Table, to: f64) -> Option<String> {
    let reached = simulation.state().t;
    let motion = table.missing().iter().rev().find_map(|missing| match &missing.cause {
        Cause::Motion(error) => Some(error),
        _ => None,
    });
    // Without an error, the loads of single rows may be missing.
    let error = motion.filter(|_| reached != to)?;
    Some(format!("the motion ends at {reached:.6} s: {}", reasons.of_motion(error)))
}

/// The number of rows with empty cells, with the time and the reason of the first; none if all cells have numbers.
fn incomplete(reasons: &Reasons, table: &Table) -> Option<String> {
    let (missing, times) = (table.missing(), table.column("time").unwrap_or_default());
    let first = missing.first()?;
    let at = times.get(first.row).map(|t| format!(", at {t:.6} s")).unwrap_or_default();
    let rows = if missing.len() == 1 { "1 row has" } else { &format!("{} rows have", missing.len()) };
    Some(format!("{rows} empty cells; the first{at}: {}", reasons.of_cells(&first.cause)))
}

/// Says on standard error which events there were; kinks of laws are none.
fn say(marks: &[Mark]) {
    let marks: Vec<&Mark> = marks.iter().filter(|mark| is_event(&mark.name)).collect();
    for mark in marks.iter().take(NAMED) {
        say!("at {:.6} s: {}", mark.at, mark.name);
    }
    if let Some(last) = marks.get(NAMED..).and_then(<[&Mark]>::last) {
        let more = marks.len() - NAMED;
        say!("{more} more events, the last at {:.6} s: {}", last.at, last.name);
    }
}
