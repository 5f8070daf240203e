//! `linkage table`: a motion as columns.

use linkage_report::Table;

use crate::arguments::{self, TableFormat};
use crate::failure::Failure;
use crate::machine::{Coordinate, Machine, Motion};
use crate::motion::Path;
use crate::output::{self, Form, form};
use crate::progress;

pub fn run(arguments: &arguments::Table) -> Result<(), Failure> {
    let forms: [Form; 2] = [("CSV", &["csv", "txt"]), ("JSON", &["json"])];
    let is_json = form(&arguments.output, "a table", &forms)? == Some(1);
    let machine = Machine::of(&arguments.numbers)?;
    let path = Path::of(&machine, &arguments.along)?;
    let rate = arguments.rate.map_or(0.0, |value| value.number);
    let mut rates = vec![0.0; machine.inputs.len()];
    rates[path.moving] = rate;
    let mut table = Table::new(names(&machine, rate != 0.0));
    let mut unwound = Unwound::default();
    let (mut missing, mut first) = (0, None);
    let steps = arguments.along.steps;
    for step in progress::over("computing", 0..steps + 1) {
        let value = path.step(step, steps);
        let inputs = path.at(value);
        let mut row = inputs.clone();
        row.extend((rate != 0.0).then(|| (value - path.ends[0]) / rate));
        match machine.motion(&inputs, &rates) {
            Ok(motion) => row.extend(numbers(&machine, &unwound.next(&machine, &motion), &motion)),
            Err(error) => {
                missing += 1;
                first.get_or_insert(error);
                row.resize(table.names().len(), f64::NAN);
            }
        }
        table.push(&row);
    }
    if let Some(error) = first {
        if missing == steps + 1 {
            return Err(Failure::Outside(error));
        }
        anstream::eprintln!("{missing} of {} rows have no position; the first: {error}", steps + 1);
    }
    let table = shown(&machine, table, arguments)?;
    let text = match arguments.format {
        TableFormat::Csv if !is_json => table.to_csv(),
        _ => table.to_json() + "\n",
    };
    output::write(&arguments.output, text.as_bytes(), &arguments.numbers.source.file)
}

/// The columns that are asked for, with angles in degrees if these are.
fn shown(machine: &Machine, table: Table, arguments: &arguments::Table) -> Result<Table, Failure> {
    let wrong = |error: linkage_report::table::TableError| Failure::Argument(error.to_string());
    let mut table = table;
    if arguments.degrees {
        let angles = machine.inputs.iter().chain(&machine.unknowns).filter(|coordinate| coordinate.is_angle);
        table = table.degrees_of(angles.map(|angle| &angle.name.text)).map_err(wrong)?;
    }
    if !arguments.columns.is_empty() {
        table = table.select(&arguments.columns).map_err(wrong)?;
    }
    Ok(match arguments.digits {
        Some(digits) => table.digits(digits),
        None => table,
    })
}

/// The names of the columns.
fn names(machine: &Machine, is_moving: bool) -> Vec<String> {
    let orders = |name: &String| ["", "_rate", "_acceleration"].map(|end| format!("{name}{end}"));
    let of_point = ["x", "y", "velocity_x", "velocity_y", "speed", "acceleration_x", "acceleration_y"];
    let inputs = machine.inputs.iter().map(|input| input.name.text.clone());
    let time = is_moving.then(|| "time".to_owned());
    let unknowns = machine.unknowns.iter().flat_map(|unknown| orders(&unknown.name.text));
    let points = machine.points.iter().flat_map(|point| of_point.map(|of| format!("{}_{of}", point.text)));
    let outputs = machine.outputs.iter().flat_map(|output| orders(&output.text));
    inputs.chain(time).chain(unknowns).chain(points).chain(outputs).collect()
}

/// The numbers of a row after inputs and time.
fn numbers(machine: &Machine, unknowns: &[f64], motion: &Motion) -> Vec<f64> {
    let mut row = Vec::new();
    for (unknown, value) in machine.unknowns.iter().zip(unknowns) {
        let field = &unknown.name.field;
        row.extend([
            *value,
            motion.number(&format!("rates.{field}")),
            motion.number(&format!("accelerations.{field}")),
        ]);
    }
    for point in &machine.points {
        let of = |path: &str| motion.number(&format!("points.{}.{path}", point.field));
        let [x, y, velocity_x, velocity_y] = ["position.x", "position.y", "velocity.x", "velocity.y"].map(of);
        row.extend([x, y, velocity_x, velocity_y, (velocity_x * velocity_x + velocity_y * velocity_y).sqrt()]);
        row.extend(["acceleration.x", "acceleration.y"].map(of));
    }
    for output in &machine.outputs {
        row.extend(
            ["value", "rate", "acceleration"].map(|of| motion.number(&format!("outputs.{}.{of}", output.field))),
        );
    }
    row
}

/// The angles of the last row: those of the next are the nearest to them.
#[derive(Default)]
struct Unwound(Option<Vec<f64>>);

impl Unwound {
    fn next(&mut self, machine: &Machine, motion: &Motion) -> Vec<f64> {
        let near = |(of, value): (&Coordinate, &f64), last: f64| match of.is_angle {
            true => value + ((last - value) / std::f64::consts::TAU).round() * std::f64::consts::TAU,
            false => *value,
        };
        let values = machine.unknowns.iter().zip(&motion.unknowns);
        let now: Vec<f64> = match &self.0 {
            Some(last) => values.zip(last).map(|(now, last)| near(now, *last)).collect(),
            None => motion.unknowns.clone(),
        };
        self.0 = Some(now.clone());
        now
    }
}
