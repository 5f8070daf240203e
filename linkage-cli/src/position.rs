//! The numbers and the picture of a sheet at one position.

use linkage_lent::Documents;
use linkage_report::sheet::{Sheet, Values};

use crate::arguments;
use crate::commands::drawing;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::machine::{Coordinate, Machine, Motion};
use crate::motion::held;

pub struct Position {
    given: Vec<(String, f64)>,
    /// None of parameters with values alone, at whose usual inputs there is no position.
    numbers: Option<Numbers>,
}

struct Numbers {
    values: Values,
    /// Numbers by name, with their captions.
    tables: Vec<(&'static str, Vec<(String, f64)>)>,
    picture: Option<String>,
    caption: String,
}

impl Position {
    /// The position that arguments ask for, and the documents of its mechanism; none if they ask for no numbers.
    pub fn of(arguments: &arguments::Sheet) -> Result<Option<(Self, Documents)>, Failure> {
        let arguments::Sheet { numbers, place, rate, live, .. } = arguments;
        let is_asked = !numbers.branch.is_empty() || !place.at.is_empty() || rate.is_some() || *live;
        if numbers.set.is_empty() && !is_asked {
            return Ok(None);
        }
        let (machine, documents) = Machine::with(numbers, Documents::of)?;
        let numbers = match Numbers::of(&machine, arguments) {
            Err(Failure::Outside(why) | Failure::Argument(why)) if !is_asked => {
                anstream::eprintln!("the sheet has no numbers of a position: {why}");
                None
            }
            numbers => Some(numbers?),
        };
        Ok(Some((Self { given: machine.parameters().to_vec(), numbers }, documents)))
    }

    pub fn add_to<'s, 'd>(&self, sheet: &'s mut Sheet<'d>) -> &'s mut Sheet<'d> {
        for (name, value) in &self.given {
            sheet.given(name, *value);
        }
        if let Some(Numbers { values, tables, picture, caption }) = &self.numbers {
            sheet.at(values.clone());
            for (caption, rows) in tables {
                sheet.numbers(*caption, rows.iter().cloned());
            }
            if let Some(picture) = picture {
                sheet.picture(picture, caption);
            }
        }
        sheet
    }
}

impl Numbers {
    fn of(machine: &Machine, arguments: &arguments::Sheet) -> Result<Self, Failure> {
        let arguments::Sheet { place, rate, .. } = arguments;
        let inputs = held(machine, &place.at, None)?;
        let mut rates = vec![0.0; inputs.len()];
        if let (Some(first), Some(rate)) = (rates.first_mut(), rate) {
            *first = rate.number;
        }
        let motion = machine.motion(&inputs, &rates).map_err(Failure::Outside)?;
        let figure = Figure::of(machine)?;
        let rates = rate.map(|_| rates.as_slice());
        Ok(Self {
            values: values(machine, &motion, rates),
            tables: tables(machine, &motion, rates),
            picture: drawing(machine, &figure, &motion).to_svg().ok(),
            caption: format!("The position at {}", machine.at(&inputs)),
        })
    }
}

/// The coordinates with their values.
fn coordinates<'m>(machine: &'m Machine, motion: &'m Motion) -> impl Iterator<Item = (&'m Coordinate, f64)> {
    let values = motion.inputs.iter().chain(&motion.unknowns);
    machine.about.inputs.iter().chain(&machine.about.unknowns).zip(values.copied())
}

/// The numbers of all names in formulas; those of rates and accelerations if the inputs have rates.
fn values(machine: &Machine, motion: &Motion, rates: Option<&[f64]>) -> Values {
    let mut values = Values::default();
    for (name, value) in machine.parameters() {
        values.set(name, 0, *value);
    }
    for (of, value) in coordinates(machine, motion) {
        values.set(&of.name.text, 0, value);
    }
    for (input, rate) in machine.about.inputs.iter().zip(rates.into_iter().flatten()) {
        values.set(&input.name.text, 1, *rate).set(&input.name.text, 2, 0.0);
    }
    for unknown in machine.about.unknowns.iter().filter(|_| rates.is_some()) {
        let of = |kind: &str| motion.number(&format!("{kind}.{}", unknown.name.field));
        values.set(&unknown.name.text, 1, of("rates")).set(&unknown.name.text, 2, of("accelerations"));
    }
    let pairs = machine.about.unknowns.iter().flat_map(|of| machine.about.inputs.iter().map(move |by| (of, by)));
    for ((of, by), ratio) in pairs.zip(machine.ratios(motion)) {
        values.set_ratio(&of.name.text, &by.name.text, ratio);
    }
    values
}

/// The numbers that no equation has: coordinates, and with rates of the inputs all rates and accelerations.
fn tables(machine: &Machine, motion: &Motion, rates: Option<&[f64]>) -> Vec<(&'static str, Vec<(String, f64)>)> {
    let all = || coordinates(machine, motion).map(|(of, value)| (of, value, of.name.text.clone()));
    let lengths = all().map(|(_, value, name)| (name, value)).collect();
    let degrees = all().filter(|(of, ..)| of.is_angle).map(|(_, value, name)| (name, value.to_degrees())).collect();
    let mut tables = vec![("Position", lengths), ("Angles in degrees", degrees)];
    let orders = [
        ("Velocities", "rates", "velocity", "rate"),
        ("Accelerations", "accelerations", "acceleration", "acceleration"),
    ];
    for (caption, of_unknown, of_point, end) in orders {
        let Some(rates) = rates else { break };
        let of_inputs = machine.about.inputs.iter().zip(rates);
        let inputs =
            of_inputs.filter(|_| end == "rate").map(|(input, rate)| (format!("{}_rate", input.name.text), *rate));
        let unknowns = machine.about.unknowns.iter().map(|unknown| {
            (format!("{}_{end}", unknown.name.text), motion.number(&format!("{of_unknown}.{}", unknown.name.field)))
        });
        let points = machine.about.points.iter().flat_map(|point| {
            ["x", "y"].map(|axis| {
                let value = motion.number(&format!("points.{}.{of_point}.{axis}", point.field));
                (format!("{axis}_{}_{end}", point.text), value)
            })
        });
        let outputs = machine.about.outputs.iter().map(|output| {
            (format!("{}_{end}", output.text), motion.number(&format!("outputs.{}.{end}", output.field)))
        });
        tables.push((caption, inputs.chain(unknowns).chain(points).chain(outputs).collect()));
    }
    tables.retain(|(_, rows): &(_, Vec<(String, f64)>)| !rows.is_empty());
    tables
}
