//! Many positions at once, as columns of numbers.

use std::cell::RefCell;
use std::rc::Rc;

use linkage_ir::code::Function;

use crate::call_error::CallError;
use crate::convert;
use crate::data::Data;
use crate::error::{Error, Mistake};
use crate::machine::{Failure, Kind, Machine, Of, Scalar as _, Value};
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
        let (driver, users) = self.parts()?;
        let given = self.all_given(driver, given)?;
        let count = length(driver, &given)?;
        let wanted: Vec<usize> = found.iter().map(|name| place(&driver.lanes.found, name)).collect::<Result<_, _>>()?;
        let branch = convert::branch(driver, branch)?;
        let has_quantities = wanted.iter().any(|place| *place >= driver.lanes.coordinates);
        let run = Run { driver, given, branch };
        let of = driver.traits.iter().find(|one| one.of == "Lanes");
        let [lane, exact] = ["lane", "exact"].map(|name| of.and_then(|of| function(of, name)));
        let missing = || CallError::Mistake(Mistake::new(format!("`{}` has no columns", driver.name)));
        let (lane, exact) = (lane.ok_or_else(missing)?, exact.ok_or_else(missing)?);
        let mut machine = Machine::new(driver, None, users, Kind::Traced);
        machine.has_quantities = has_quantities;
        let tape = run.recorded(&mut machine, lane, &wanted)?;
        let mut block = Block::new(&tape);
        let mut columns: Vec<Vec<f64>> = wanted.iter().map(|_| Vec::with_capacity(count)).collect();
        let mut rejected = Vec::new();
        for from in (0..count).step_by(WIDTH) {
            let width = WIDTH.min(count - from);
            block.run(|column, numbers| run.numbers(column, from, numbers));
            for (place, column) in columns.iter_mut().enumerate() {
                let numbers = block.found(place);
                column.extend(numbers.iter().take(width).map(|number| existing(*number)));
            }
            let accepted = block.accepted();
            for place in (from..from + width).filter(|place| !accepted[place - from]) {
                match run.alone(&mut machine, exact, place)? {
                    Ok(values) => {
                        for (column, of) in columns.iter_mut().zip(&wanted) {
                            column[place] = existing(values.get(*of).copied().unwrap_or(f64::NAN));
                        }
                    }
                    Err(error) => {
                        columns.iter_mut().for_each(|column| column[place] = f64::NAN);
                        rejected.push(Rejected { place, error });
                    }
                }
            }
        }
        Ok(Columns { columns, rejected })
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

/// A computation of columns.
struct Run<'r> {
    driver: &'r Driver,
    given: Vec<Values<'r>>,
    branch: Value,
}

impl Run<'_> {
    /// The mechanism with the parameters among these columns.
    fn own(&self, columns: &[Value]) -> Value {
        let values = self.driver.parameters.iter().copied().zip(columns.iter().cloned());
        Value::record(values)
    }

    /// The tape of the wanted columns.
    fn recorded<'c>(&self, machine: &mut Machine<'c>, lane: &'c Function, wanted: &[usize]) -> Result<Tape, CallError> {
        let recorder = Rc::new(RefCell::new(Recorder::default()));
        let given = self.given.iter().enumerate().map(|(column, values)| match values {
            Values::Same(value) => Value::Number(*value),
            Values::Each(_) => Value::Traced(Recorder::given(&recorder, column)),
        });
        let given: Vec<Value> = given.collect();
        let arguments = [Value::list(given.iter().cloned()), self.branch.clone()];
        let (accepted, found) = machine.lanes(lane, self.own(&given), arguments, self.driver.lanes.found.len())?;
        // A column that is not computed is that of a function that accepts no lane.
        let number = |place: &usize| found.get(*place).and_then(Traced::of).unwrap_or(Traced::Constant(f64::NAN));
        Ok(recorded(&recorder, wanted.iter().map(number).collect(), accepted))
    }

    /// The numbers of a column in a block; after the last stand those of the first.
    fn numbers(&self, column: usize, from: usize, numbers: &mut [f64; WIDTH]) {
        let Some(Values::Each(values)) = self.given.get(column) else { return };
        let rest = values.get(from..).unwrap_or_default();
        match rest.first_chunk() {
            Some(block) => *numbers = *block,
            None => {
                numbers.fill(rest.first().copied().unwrap_or(f64::NAN));
                numbers.iter_mut().zip(rest).for_each(|(to, value)| *to = *value);
            }
        }
    }

    /// One position by the functions for one.
    fn alone<'c>(
        &self,
        machine: &mut Machine<'c>,
        exact: &'c Function,
        place: usize,
    ) -> Result<Result<Vec<f64>, Error>, CallError> {
        let at = |values: &Values<'_>| match values {
            Values::Same(value) => Value::Number(*value),
            Values::Each(values) => Value::Number(values.get(place).copied().unwrap_or(f64::NAN)),
        };
        let given: Vec<Value> = self.given.iter().map(at).collect();
        machine.set_kind(Kind::Double);
        let own = self.own(&given);
        match machine.call(Of::Driver, exact, own, [Value::list(given), self.branch.clone()]) {
            Ok(found) => {
                let numbers =
                    found.as_list().map_err(CallError::Defect)?.iter().map(|value| f64::of(value).unwrap_or(f64::NAN));
                Ok(Ok(numbers.collect()))
            }
            Err(failure) => match *failure {
                Failure::Error(error) => Ok(Err(error)),
                other => Err(Box::new(other).into()),
            },
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
