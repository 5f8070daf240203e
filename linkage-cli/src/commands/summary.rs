//! The summary of a table: the least and the largest value of each column, and where they are.

use linkage_report::Table;
use serde::Serialize;

use crate::aligned::aligned;
use crate::arguments::TableFormat;
use crate::failure::Failure;

/// The extremes of columns.
pub struct Summary {
    /// The moving input.
    input: String,
    columns: Vec<Extremes>,
}

/// The extremes of a column, none if it has no numbers.
#[derive(Serialize)]
struct Extremes {
    column: String,
    unit: Option<String>,
    minimum: Option<f64>,
    /// The input there.
    at_minimum: Option<f64>,
    maximum: Option<f64>,
    at_maximum: Option<f64>,
    swing: Option<f64>,
}

impl Summary {
    /// The summary of these columns of a table; the units are those of a table without rows.
    pub fn of(table: &Table, units: &Table, input: &str, names: &[String]) -> Result<Self, Failure> {
        let places = table.column(input).unwrap_or_default();
        let heads = heads(units)?;
        let head = |name: &str| heads.iter().find(|(other, _)| other == name);
        let columns = names.iter().map(|name| {
            let values = table.column(name).unwrap_or_default();
            let present = || places.iter().zip(values).filter(|(_, value)| value.is_finite());
            let least = present().min_by(|(_, one), (_, other)| one.total_cmp(other));
            let largest = present().rev().max_by(|(_, one), (_, other)| one.total_cmp(other));
            Extremes {
                column: name.clone(),
                unit: head(name).and_then(|(_, unit)| unit.clone()),
                minimum: least.map(|(_, value)| *value),
                at_minimum: least.map(|(at, _)| *at),
                maximum: largest.map(|(_, value)| *value),
                at_maximum: largest.map(|(at, _)| *at),
                swing: least.zip(largest).map(|((_, least), (_, largest))| largest - least),
            }
        });
        let unit = head(input).and_then(|(_, unit)| unit.as_deref());
        Ok(Self { input: with_unit(input, unit), columns: columns.collect() })
    }

    pub fn to_text(&self, format: TableFormat, digits: Option<usize>) -> Result<String, Failure> {
        if format == TableFormat::Json {
            let json = serde_json::to_string_pretty(&self.columns);
            return Ok(json.map_err(|error| Failure::Outside(error.to_string()))? + "\n");
        }
        let heads =
            ["column", "minimum", &format!("at {}", self.input), "maximum", &format!("at {}", self.input), "swing"];
        let heads = heads.map(str::to_owned).to_vec();
        let row = |of: &Extremes| {
            let numbers = [of.minimum, of.at_minimum, of.maximum, of.at_maximum, of.swing];
            let numbers = numbers.iter().map(|number| number.map(|number| written(number, digits)).unwrap_or_default());
            std::iter::once(with_unit(&of.column, of.unit.as_deref())).chain(numbers).collect()
        };
        let rows: Vec<Vec<String>> = std::iter::once(heads).chain(self.columns.iter().map(row)).collect();
        Ok(match format {
            TableFormat::Text => aligned(rows),
            _ => rows.iter().map(|row| row.join(",") + "\n").collect(),
        })
    }
}

fn with_unit(name: &str, unit: Option<&str>) -> String {
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"))
}

/// The names of the columns with their units, as the heads of the table have them.
fn heads(table: &Table) -> Result<Vec<(String, Option<String>)>, Failure> {
    let json = table.to_json();
    let of: serde_json::Value = serde_json::from_str(&json).map_err(|error| Failure::Outside(error.to_string()))?;
    let text = |value: &serde_json::Value| value.as_str().map(str::to_owned);
    let columns = of["columns"].as_array().into_iter().flatten();
    Ok(columns.map(|column| (text(&column["name"]).unwrap_or_default(), text(&column["unit"]))).collect())
}

/// A number as the table writes it.
fn written(number: f64, digits: Option<usize>) -> String {
    let mut table = Table::new(["number"]);
    table.push(&[number]);
    let table = digits.map_or(table.clone(), |digits| table.digits(digits));
    table.to_csv().lines().nth(1).unwrap_or_default().to_owned()
}
