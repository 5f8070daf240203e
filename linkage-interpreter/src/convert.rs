//! Between the data of a caller and the values of the machine.

use std::sync::Arc;

use linkage_ir::Name;
use linkage_ir::code::{Passed, Type};
use linkage_runtime::AssemblyMode;

use crate::data::Data;
use crate::error::Mistake;
use crate::machine::Value;
use crate::program::{Driver, Side};
use crate::shape::{Record, passed};

/// The value of an argument of a function of the type with this name.
pub(crate) fn to_value(driver: &Driver, data: &Data, of: &Passed, itself: &str) -> Result<Value, Mistake> {
    let Some(of) = passed(of) else { return any(driver, data) };
    match driver.record(of, itself) {
        Some(Record::Inputs) => by_name(driver, data, &driver.inputs),
        Some(Record::Coordinates | Record::Rates | Record::Accelerations | Record::Jerks) => {
            by_name(driver, data, &driver.coordinates)
        }
        Some(Record::Branch) => branch(driver, data),
        None if matches!(of, Type::Scalar | Type::Lanes) => {
            data.number().map(Value::Number).ok_or_else(|| Mistake::expected("a number", data))
        }
        _ => any(driver, data),
    }
}

/// Numbers by name: from fields, from a list in order, or from the only number.
fn by_name(driver: &Driver, data: &Data, names: &[Name]) -> Result<Value, Mistake> {
    let number = |data: &Data| data.number().map(Value::Number).ok_or_else(|| Mistake::expected("a number", data));
    let values = match data {
        Data::Number(_) | Data::Count(_) if names.len() == 1 => vec![number(data)?],
        Data::List(all) if all.len() == names.len() => all.iter().map(number).collect::<Result<_, _>>()?,
        Data::Fields(fields) => {
            if let Some((unknown, _)) = fields.iter().find(|(name, _)| !names.iter().any(|of| driver.is(*of, name))) {
                return Err(Mistake::unknown(unknown, names.iter().map(|name| driver.names.text(*name))));
            }
            let value = |name: &Name| {
                let found = fields.iter().find(|(field, _)| driver.is(*name, field));
                let (_, value) = found.ok_or_else(|| Mistake::missing(driver.names.text(*name)))?;
                number(value)
            };
            names.iter().map(value).collect::<Result<_, _>>()?
        }
        other => return Err(Mistake::expected("numbers by name", other)),
    };
    Ok(Value::record(names.iter().copied().zip(values)))
}

/// A branch: a word for each group with two solutions; turns are 0 and positions have no number if they are not given.
pub(crate) fn branch(driver: &Driver, data: &Data) -> Result<Value, Mistake> {
    let sides = driver.sides.iter().map(|side| side.field);
    let modes = driver.modes.iter().map(|(field, _)| *field);
    let names: Vec<Name> = sides.chain(modes).chain(driver.turns.iter().copied()).collect();
    let nothing = Vec::new();
    let fields = match data {
        Data::Fields(fields) => fields,
        Data::Nothing => &nothing,
        other => return Err(Mistake::expected("a branch by name", other)),
    };
    if let Some((unknown, _)) = fields.iter().find(|(name, _)| !names.iter().any(|of| driver.is(*of, name))) {
        return Err(Mistake::unknown(unknown, names.iter().map(|name| driver.names.text(*name))));
    }
    let given = |name: Name| fields.iter().find(|(field, _)| driver.is(name, field)).map(|(_, value)| value);
    let mut values = Vec::with_capacity(names.len());
    for side in &driver.sides {
        let word = given(side.field).ok_or_else(|| Mistake::missing(driver.names.text(side.field)))?;
        values.push((side.field, solution(side, word)?));
    }
    for (field, _) in &driver.modes {
        let mode = match given(*field) {
            None | Some(Data::Nothing) => AssemblyMode::OfGuess,
            Some(Data::Count(number)) if *number >= 0 => AssemblyMode::Number(*number as usize),
            Some(other) => return Err(Mistake::expected("the number of a position", other)),
        };
        values.push((*field, Value::Mode(mode)));
    }
    for field in &driver.turns {
        let turn = match given(*field) {
            None => 0,
            Some(Data::Count(turn)) => *turn,
            Some(other) => return Err(Mistake::expected("a turn", other)),
        };
        values.push((*field, Value::Count(turn)));
    }
    Ok(Value::record(values))
}

fn solution(side: &Side, word: &Data) -> Result<Value, Mistake> {
    let Data::Text(word) = word else { return Err(Mistake::expected("a solution", word)) };
    match side.solutions.iter().position(|solution| solution.eq_ignore_ascii_case(word)) {
        Some(place) => Ok(Value::Side(place == 0)),
        None => Err(Mistake::unknown(word, side.solutions.iter().map(|solution| &**solution))),
    }
}

/// A value by its parts.
fn any(driver: &Driver, data: &Data) -> Result<Value, Mistake> {
    Ok(match data {
        Data::Nothing => Value::Absent,
        Data::Flag(flag) => Value::Flag(*flag),
        Data::Count(count) => Value::Count(*count),
        Data::Number(number) => Value::Number(*number),
        Data::Text(text) => Value::Text(text.clone()),
        Data::List(all) => Value::list(all.iter().map(|data| any(driver, data)).collect::<Result<Vec<_>, _>>()?),
        Data::Fields(fields) => {
            let fields = fields.iter().map(|(name, data)| {
                let name = driver.names.find(name).ok_or_else(|| Mistake::unknown(name, []))?;
                Ok((name, any(driver, data)?))
            });
            Value::record(fields.collect::<Result<Vec<_>, Mistake>>()?)
        }
    })
}

/// The data of a result.
pub(crate) fn to_data(driver: &Driver, value: &Value) -> Data {
    match value {
        Value::Number(number) => Data::Number(*number),
        Value::Wide(number) => Data::Number(number.high()),
        Value::Flag(flag) => Data::Flag(*flag),
        Value::Count(count) => Data::Count(*count),
        Value::Text(text) => Data::Text(text.clone()),
        Value::List(all) => Data::List(all.iter().map(|value| to_data(driver, value)).collect()),
        Value::Matrix(columns) => by_rows(driver, columns),
        Value::Record(record) => {
            let fields = record.fields.iter().map(|(name, value)| {
                let data = match value {
                    Value::Side(is_first) => solution_of(driver, *name, *is_first),
                    value => to_data(driver, value),
                };
                (driver.names.shared(*name), data)
            });
            Data::Fields(fields.collect())
        }
        Value::Mode(AssemblyMode::Number(number)) => Data::Count(*number as i64),
        _ => Data::Nothing,
    }
}

fn by_rows(driver: &Driver, columns: &[Value]) -> Data {
    let columns: Vec<Vec<Data>> = columns
        .iter()
        .map(|column| column.as_list().unwrap_or_default().iter().map(|entry| to_data(driver, entry)).collect())
        .collect();
    let rows = columns.first().map_or(0, Vec::len);
    let row = |row: usize| Data::List(columns.iter().filter_map(|column| column.get(row).cloned()).collect());
    Data::List((0..rows).map(row).collect())
}

fn solution_of(driver: &Driver, field: Name, is_first: bool) -> Data {
    let side = driver.sides.iter().find(|side| side.field == field);
    side.map_or(Data::Nothing, |side| Data::Text(Arc::clone(&side.solutions[usize::from(!is_first)])))
}
