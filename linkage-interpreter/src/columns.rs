//! Many positions at once, as columns of numbers, and one at a time, as rows of them.

use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;

use linkage_ir::code::Function;

use crate::call_error::CallError;
use crate::convert;
use crate::data::Data;
use crate::error::{Error, Mistake};
use crate::machine::{Kind, Machine, Of, Scalar as _, Value};
use crate::mechanism::Design;
use crate::program::{Driver, Implementation};
use crate::tape::{Block, Recorder, Tape, Traced, WIDTH, recorded};

/// One number for each position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'v> {
    /// One for all.
    Same(f64),
    /// One for each.
    Each(&'v [f64]),
}

impl From<f64> for Values<'_> {
    fn from(value: f64) -> Self {
        Self::Same(value)
    }
}

impl<'v> From<&'v [f64]> for Values<'v> {
    fn from(values: &'v [f64]) -> Self {
        Self::Each(values)
    }
}

/// The columns that were found, in the order in which they were asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// The columns: NaN where there is no position, and where a point or an output has no value.
    pub columns: Vec<Vec<f64>>,
    /// The positions that do not exist, in order.
    pub rejected: Vec<Rejected>,
}

/// A position that does not exist.
#[derive(Debug, Clone, PartialEq)]
pub struct Rejected {
    /// Its place in the columns.
    pub place: usize,
    /// The error of `kinematics`.
    pub error: Error,
}

impl Design {
    /// The names of the columns that [`columns`](Self::columns) takes: parameters, inputs (of a mechanism without closed form
    /// all coordinates of a guess), their rates `x_rate` and accelerations `x_acceleration`.
    ///
    /// # Errors
    /// If a user function is not given.
    pub fn given_columns(&self) -> Result<&[String], Mistake> {
        Ok(&self.parts()?.0.lanes.given)
    }

    /// The names of the columns that [`columns`](Self::columns) finds.
    ///
    /// # Errors
    /// If a user function is not given.
    pub fn found_columns(&self) -> Result<&[String], Mistake> {
        Ok(&self.parts()?.0.lanes.found)
    }

    /// Computes positions from columns by name. A parameter that is not given has its value in the design, a rate or an
    /// acceleration is zero.
    ///
    /// # Errors
    /// [`CallError::Mistake`] for an unknown name, an input that is not given, and columns of different lengths.
    pub fn columns(&self, given: &[(&str, Values<'_>)], branch: &Data, found: &[&str]) -> Result<Columns, CallError> {
        let (driver, _) = self.parts()?;
        let given = self.all_given(driver, given)?;
        let count = length(driver, &given)?;
        let same = given.iter().map(|values| match values {
            Values::Same(value) => Some(*value),
            Values::Each(_) => None,
        });
        let (mut alone, tape) = self.recorded(&same.collect::<Vec<_>>(), branch, found)?;
        let mut block = Block::<WIDTH>::new(tape);
        let mut columns: Vec<Vec<f64>> = found.iter().map(|_| Vec::with_capacity(count)).collect();
        let mut rejected = Vec::new();
        for from in (0..count).step_by(WIDTH) {
            let width = WIDTH.min(count - from);
            block.run(|column, numbers| in_block(given.get(column), from, numbers));
            for (place, column) in columns.iter_mut().enumerate() {
                let numbers = block.found(place);
                column.extend(numbers.iter().take(width).map(|number| existing(*number)));
            }
            let accepted = block.accepted();
            for place in (from..from + width).filter(|place| !accepted[place - from]) {
                let at = |values: &Values<'_>| match values {
                    Values::Same(value) => *value,
                    Values::Each(values) => values.get(place).copied().unwrap_or(f64::NAN),
                };
                let numbers = match alone.find(given.iter().map(at)) {
                    Ok(numbers) => numbers,
                    Err(CallError::Function(error)) => {
                        rejected.push(Rejected { place, error });
                        vec![f64::NAN; found.len()]
                    }
                    Err(error) => return Err(error),
                };
                columns.iter_mut().zip(numbers).for_each(|(column, number)| column[place] = number);
            }
        }
        Ok(Columns { columns, rejected })
    }

    /// Prepares positions that are computed one at a time: the numbers of [`columns`](Self::columns) as rows. `given` names the
    /// numbers of each position; all others are as in columns that do not have them.
    ///
    /// # Errors
    /// As [`columns`](Self::columns).
    pub fn row(&self, given: &[&str], branch: &Data, found: &[&str]) -> Result<Row<'_>, CallError> {
        let (driver, _) = self.parts()?;
        let columns: Vec<(&str, Values<'_>)> = given.iter().map(|name| (*name, Values::Each(&[]))).collect();
        let all = self.all_given(driver, &columns)?;
        let places = driver.lanes.given.iter().map(|name| given.iter().position(|other| other == name));
        let same = all.iter().map(|values| match values {
            Values::Same(value) => Some(*value),
            Values::Each(_) => None,
        });
        let same: Vec<Option<f64>> = same.collect();
        let (alone, tape) = self.recorded(&same, branch, found)?;
        let sources = places.zip(same).map(|(place, same)| match (same, place) {
            (None, Some(place)) => Source::Given(place),
            (same, _) => Source::Same(same.unwrap_or(f64::NAN)),
        });
        let sources = sources.collect();
        Ok(Row { alone, block: Block::new(tape), sources, given: given.len() })
    }

    /// The functions for one position, and the tape of the wanted columns: `same` has the numbers that all positions have.
    fn recorded(&self, same: &[Option<f64>], branch: &Data, found: &[&str]) -> Result<(Alone<'_>, Tape), CallError> {
        let (driver, users) = self.parts()?;
        let wanted: Vec<usize> = found.iter().map(|name| place(&driver.lanes.found, name)).collect::<Result<_, _>>()?;
        let branch = convert::branch(driver, branch)?;
        let of = driver.traits.iter().find(|one| one.of == "Lanes");
        let [lane, exact] = ["lane", "exact"].map(|name| of.and_then(|of| function(of, name)));
        let missing = || CallError::Mistake(Mistake::new(format!("`{}` has no columns", driver.name)));
        let (lane, exact) = (lane.ok_or_else(missing)?, exact.ok_or_else(missing)?);
        let mut machine = Machine::new(driver, None, users, Kind::Traced);
        machine.has_quantities = wanted.iter().any(|place| *place >= driver.lanes.coordinates);
        let recorder = Rc::new(RefCell::new(Recorder::default()));
        let given = same.iter().enumerate().map(|(column, same)| match same {
            Some(value) => Value::Number(*value),
            None => Value::Traced(Recorder::given(&recorder, column)),
        });
        let given: Vec<Value> = given.collect();
        let arguments = [Value::list(given.iter().cloned()), branch.clone()];
        let (accepted, columns) = machine.lanes(lane, own(driver, &given), arguments, driver.lanes.found.len())?;
        // A column that is not computed is that of a function that accepts no lane.
        let number = |place: &usize| columns.get(*place).and_then(Traced::of).unwrap_or(Traced::Constant(f64::NAN));
        let tape = recorded(&recorder, wanted.iter().map(number).collect(), accepted);
        machine.set_kind(Kind::Double);
        Ok((Alone { driver, machine, exact, branch, wanted }, tape))
    }

    /// The given columns in their order.
    fn all_given<'v>(&self, driver: &Driver, given: &[(&str, Values<'v>)]) -> Result<Vec<Values<'v>>, Mistake> {
        let lanes = &driver.lanes;
        for (name, _) in given {
            place(&lanes.given, name)?;
        }
        let parameters = self.parameters();
        let value = |(place, name): (usize, &String)| {
            let own = given.iter().find(|(other, _)| other == name).map(|(_, values)| *values);
            match (own, parameters.get(place)) {
                (Some(values), _) => Ok(values),
                (None, Some(parameter)) => Ok(Values::Same(*parameter)),
                (None, None) if place < parameters.len() + lanes.start => Err(Mistake::missing(name)),
                (None, None) => Ok(Values::Same(0.0)),
            }
        };
        lanes.given.iter().enumerate().map(value).collect()
    }
}

/// Positions one at a time, with what they have in common computed before.
pub struct Row<'d> {
    alone: Alone<'d>,
    block: Block<1>,
    sources: Vec<Source>,
    /// The count of numbers of a position.
    given: usize,
}

impl fmt::Debug for Row<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Row").field(&self.alone.driver.name).finish()
    }
}

/// The source of the number of a given column.
#[derive(Debug, Clone, Copy)]
enum Source {
    Same(f64),
    Given(usize),
}

impl Row<'_> {
    /// Finds the wanted numbers of a position, in the order of their names: NaN where a point or an output has no value.
    ///
    /// # Errors
    /// [`CallError::Function`] where there is no position, with the error of `kinematics`; [`CallError::Mistake`] for lists of other
    /// lengths.
    pub fn find(&mut self, given: &[f64], found: &mut [f64]) -> Result<(), CallError> {
        let Self { alone, block, sources, given: count } = self;
        for (name, expected, list) in [("given", *count, given.len()), ("found", alone.wanted.len(), found.len())] {
            if list != expected {
                return Err(Mistake::new(format!("the list of {name} numbers has {list} of {expected}")).into());
            }
        }
        let number = |source: &Source| match *source {
            Source::Same(value) => value,
            Source::Given(place) => given.get(place).copied().unwrap_or(f64::NAN),
        };
        block.run(|column, [to]| *to = sources.get(column).map_or(f64::NAN, number));
        if block.accepted() == [true] {
            for (place, to) in found.iter_mut().enumerate() {
                let [value] = block.found(place);
                *to = existing(value);
            }
            return Ok(());
        }
        found.copy_from_slice(&alone.find(sources.iter().map(number))?);
        Ok(())
    }
}

/// The functions for one position, which find those that a lane does not.
struct Alone<'d> {
    driver: &'d Driver,
    machine: Machine<'d>,
    exact: &'d Function,
    branch: Value,
    wanted: Vec<usize>,
}

impl Alone<'_> {
    /// The wanted numbers of the position with these given numbers.
    fn find(&mut self, given: impl Iterator<Item = f64>) -> Result<Vec<f64>, CallError> {
        let given: Vec<Value> = given.map(Value::Number).collect();
        let own = own(self.driver, &given);
        let found = self.machine.call(Of::Driver, self.exact, own, [Value::list(given), self.branch.clone()])?;
        let found = found.as_list().map_err(CallError::Defect)?;
        let number = |place: &usize| found.get(*place).and_then(f64::of);
        Ok(self.wanted.iter().map(|place| existing(number(place).unwrap_or(f64::NAN))).collect())
    }
}

/// The mechanism with the parameters among these columns.
fn own(driver: &Driver, columns: &[Value]) -> Value {
    Value::record(driver.parameters.iter().copied().zip(columns.iter().cloned()))
}

/// The numbers of a column in a block; after the last stand those of the first.
fn in_block(values: Option<&Values<'_>>, from: usize, numbers: &mut [f64; WIDTH]) {
    let Some(Values::Each(values)) = values else { return };
    let rest = values.get(from..).unwrap_or_default();
    match rest.first_chunk() {
        Some(block) => *numbers = *block,
        None => {
            numbers.fill(rest.first().copied().unwrap_or(f64::NAN));
            numbers.iter_mut().zip(rest).for_each(|(to, value)| *to = *value);
        }
    }
}

fn length(driver: &Driver, given: &[Values<'_>]) -> Result<usize, Mistake> {
    let mut count = None;
    for (values, name) in given.iter().zip(&driver.lanes.given) {
        if let Values::Each(values) = values {
            let expected = *count.get_or_insert(values.len());
            if values.len() != expected {
                let found = values.len();
                return Err(Mistake::new(format!("the column `{name}` has {found} entries instead of {expected}")));
            }
        }
    }
    Ok(count.unwrap_or(1))
}

fn place(names: &[String], name: &str) -> Result<usize, Mistake> {
    let found = names.iter().position(|other| other == name);
    found.ok_or_else(|| Mistake::unknown(name, names.iter().map(String::as_str)))
}

fn function<'f>(of: &'f Implementation, name: &str) -> Option<&'f Function> {
    of.functions.iter().find(|function| function.name == name)
}

/// A number, or NaN if it is not finite.
fn existing(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}
