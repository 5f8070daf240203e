//! `linkage table`: a motion as columns.

use linkage_compiler::diagnostics::{is_near, suggestion};
use linkage_report::Table;
use linkage_report::table::at_kink;

use super::summary::Summary;
use crate::about::About;
use crate::aligned::aligned;
use crate::arguments::{self, TableFormat};
use crate::columns;
use crate::failure::Failure;
use crate::followed::Followed;
use crate::machine::{Machine, Motion};
use crate::motion::Path;
use crate::names::listed;
use crate::output::{self, Form, form};
use crate::progress;
use crate::said::say_jumps;
use crate::unwound::{Turned, Unwound};

/// The digits of a table for readers.
pub const FOR_READERS: usize = 6;

/// The most near names of a column that does not exist.
const MOST_NEAR: usize = 6;

pub fn run(arguments: &arguments::Table) -> Result<(), Failure> {
    let format = format(arguments)?;
    let machine = Machine::of(&arguments.numbers)?;
    let path = Path::of(&machine, &arguments.along)?;
    let rate = rate(&machine, &path, arguments)?;
    let all = columns::names(
        [&machine.about.inputs, &machine.about.unknowns],
        [&machine.about.points, &machine.about.outputs],
        rate != 0.0,
    );
    let asked = asked(&all, &arguments.shown.columns)?;
    let mut table = Table::new(all);
    let mut unwound = Unwound::default();
    let (mut missing, mut kinks) = (Vec::new(), Vec::new());
    let steps = arguments.along.steps;
    let prepared = machine.solver.design.prepared();
    let followed = Followed::of(&machine, &prepared, &path, (0..=steps).map(|step| path.step(step, steps)))?;
    for step in progress::over("computing", 0..steps + 1) {
        let value = path.step(step, steps);
        let inputs = path.at(value);
        let mut row = inputs.clone();
        row.extend((rate != 0.0).then(|| ((value - path.ends[0]) / rate).abs()));
        match followed.motion(value, rate) {
            Ok(motion) => row.extend(numbers(&machine, &unwound.next(&machine, &motion)?, &motion)?),
            Err(error) => match followed.next_to(value, rate) {
                Some(next) => {
                    let [before, after] = next.each_ref().map(|motion| {
                        let turned = unwound.next(&machine, motion)?;
                        numbers(&machine, &turned, motion)
                    });
                    let names: Vec<&str> = table.names().into_iter().skip(row.len()).collect();
                    let at_kink = at_kink(&names, &before?, &after?);
                    let names = names.into_iter().zip(&at_kink);
                    kinks.extend(names.filter(|(_, number)| number.is_nan()).map(|(name, _)| (value, name.to_owned())));
                    row.extend(at_kink);
                }
                None => {
                    missing.push((value, error));
                    row.resize(table.names().len(), f64::NAN);
                }
            },
        }
        table.push(&row);
    }
    match missing.first() {
        Some((_, error)) if missing.len() == steps as usize + 1 => return Err(Failure::Outside(error.clone())),
        _ => followed.say(&missing, &format!("{} rows", steps + 1)),
    }
    followed.say_kinks(&kinks, &asked);
    say_jumps(&machine, &asked);
    let digits = arguments.shown.digits.or((format == TableFormat::Text).then_some(FOR_READERS));
    let table = with_units(&machine, table, arguments.shown.degrees)?;
    let text = match arguments.shown.summary {
        true => {
            let units = with_units(&machine, Table::new(table.names()), arguments.shown.degrees)?;
            let input = &machine.about.inputs[path.moving].name.text;
            Summary::of(&table, &units, input, &summed(&machine, &table, &asked))?.to_text(format, digits)?
        }
        false => {
            // For readers, rates that are all zero are left out.
            let is_at_rest = format == TableFormat::Text && rate == 0.0 && asked.is_empty();
            let asked = if is_at_rest { at_rest(&machine) } else { asked };
            written(table, &asked, digits, format)?
        }
    };
    output::write(&arguments.output, text.as_bytes(), &arguments.numbers.source.file)
}

/// The columns of a position.
fn at_rest(machine: &Machine) -> Vec<String> {
    let About { inputs, unknowns, points, outputs, .. } = &machine.about;
    columns::names_at_rest([inputs, unknowns], [points, outputs])
}

/// The table in a form: these columns of it, or all.
pub fn written(table: Table, asked: &[String], digits: Option<usize>, format: TableFormat) -> Result<String, Failure> {
    let table = if asked.is_empty() { table } else { table.select(asked).map_err(wrong)? };
    let table = digits.map_or(table.clone(), |digits| table.digits(digits));
    Ok(match format {
        TableFormat::Csv => table.to_csv(),
        TableFormat::Json => table.to_json() + "\n",
        TableFormat::Text => aligned(table.cells()),
    })
}

fn wrong(error: linkage_report::table::TableError) -> Failure {
    Failure::Argument(error.to_string())
}

/// The form that is asked for, by its name or by the ending of the file.
fn format(arguments: &arguments::Table) -> Result<TableFormat, Failure> {
    let of_place = [TableFormat::Csv, TableFormat::Json, TableFormat::Text];
    let forms: [Form; 3] = [("CSV", &["csv"]), ("JSON", &["json"]), ("text", &["txt"])];
    let usual = if arguments.shown.summary { TableFormat::Text } else { TableFormat::Csv };
    let of_ending = form(&arguments.output, "a table", &forms)?.and_then(|place| of_place.get(place).copied());
    Ok(arguments.format.or(of_ending).unwrap_or(usual))
}

/// The rate of the moving input, 0 without one. Time begins at 0 and goes on, so the rate has the direction of the range.
fn rate(machine: &Machine, path: &Path, arguments: &arguments::Table) -> Result<f64, Failure> {
    let Some(value) = arguments.rate else { return Ok(0.0) };
    let input = &machine.about.inputs[path.moving];
    let name = &input.name.text;
    let rate = input.rate(value)?;
    let [from, to] = path.ends;
    if rate == 0.0 {
        return Err(Failure::Argument(format!(
            "at --rate 0, `{name}` does not move: leave it out, or write such as 45rpm"
        )));
    }
    if (rate > 0.0) != (to > from) {
        let [rate, range] = if rate > 0.0 { ["grows", "falls"] } else { ["falls", "grows"] };
        let message =
            format!("at this --rate `{name}` {rate}, and it {range} from --from to --to: change the sign or the ends");
        return Err(Failure::Argument(message));
    }
    Ok(rate)
}

/// The columns that are asked for.
pub fn asked(all: &[String], columns: &[String]) -> Result<Vec<String>, Failure> {
    let asked = joined(all, columns);
    match asked.iter().find(|name| !all.contains(name)) {
        None => Ok(asked),
        Some(name) if name == "time" => {
            Err(Failure::Argument("`time` is a column of a motion with a rate: write --rate VALUE".to_owned()))
        }
        Some(name) => {
            let is_like = |other: &&String| {
                is_near(&name.to_lowercase(), &other.to_lowercase()) || other.starts_with(&format!("{name}_"))
            };
            let near: Vec<&str> = all.iter().filter(is_like).map(String::as_str).take(MOST_NEAR).collect();
            let near = match near.as_slice() {
                [] => suggestion(name, all.iter().map(String::as_str)).replace('?', ""),
                near => format!("; near names: {}", listed(near)),
            };
            Err(Failure::Argument(format!("the table has no column `{name}`{near}; `linkage names` lists all columns")))
        }
    }
}

/// Names that were divided at commas. A name that has a comma, as `stop on atan2(y, x)`, is put together again.
fn joined(all: &[String], parts: &[String]) -> Vec<String> {
    let (mut names, mut at) = (Vec::new(), 0);
    while at < parts.len() {
        let upto = |end: &usize| parts[at..*end].join(",").trim().to_owned();
        let end = (at + 1..=parts.len()).rev().find(|end| all.contains(&upto(end))).unwrap_or(at + 1);
        names.push(upto(&end));
        at = end;
    }
    names.retain(|name| !name.is_empty());
    names
}

/// The columns of a summary: those that are asked for, or all that move: no inputs, no time, and rates with `--rate` only.
fn summed(machine: &Machine, table: &Table, asked: &[String]) -> Vec<String> {
    if !asked.is_empty() {
        return asked.to_vec();
    }
    let is_moving = table.column("time").is_some();
    let is_given = |name: &str| name == "time" || machine.about.inputs.iter().any(|input| input.name.text == name);
    let all = if is_moving { table.names().into_iter().map(str::to_owned).collect() } else { at_rest(machine) };
    all.into_iter().filter(|name| !is_given(name)).collect()
}

/// The table with the unit of time, and with angles in degrees if these are asked for.
pub fn with_units(machine: &Machine, mut table: Table, is_in_degrees: bool) -> Result<Table, Failure> {
    if table.column("time").is_some() {
        table = table.unit("time", "s").map_err(wrong)?;
    }
    let coordinates =
        machine.about.inputs.iter().chain(&machine.about.unknowns).filter(|coordinate| coordinate.is_angle);
    let outputs = machine.about.outputs.iter().zip(&machine.about.output_angles).filter(|(_, angle)| angle.is_some());
    let names = coordinates.map(|angle| &angle.name.text).chain(outputs.map(|(output, _)| &output.text));
    // A chart has angles in degrees also where the table has radians.
    if is_in_degrees { table.degrees_of(names) } else { table.angles_of(names) }.map_err(wrong)
}

/// The numbers of a row after inputs and time.
fn numbers(machine: &Machine, turned: &Turned, motion: &Motion) -> Result<Vec<f64>, Failure> {
    let mut row = Vec::new();
    for (unknown, value) in machine.about.unknowns.iter().zip(&turned.unknowns) {
        let field = &unknown.name.field;
        row.push(*value);
        row.push(motion.number(&format!("rates.{field}"))?);
        row.push(motion.number(&format!("accelerations.{field}"))?);
    }
    for point in &machine.about.points {
        let of = format!("points.{}", point.field);
        let [x, y, velocity_x, velocity_y] =
            motion.numbers(&of, ["position.x", "position.y", "velocity.x", "velocity.y"])?;
        row.extend([x, y, velocity_x, velocity_y, (velocity_x * velocity_x + velocity_y * velocity_y).sqrt()]);
        row.extend(motion.numbers(&of, ["acceleration.x", "acceleration.y"])?);
    }
    for (output, value) in machine.about.outputs.iter().zip(&turned.outputs) {
        row.push(*value);
        row.extend(motion.numbers(&format!("outputs.{}", output.field), ["rate", "acceleration"])?);
    }
    Ok(row)
}
