//! Motions, loads and simulations as columns of numbers, as CSV and as JSON.
//!
//! | function | rows | columns |
//! |---|---|---|
//! | [`Table::turn`], [`Table::at`], [`Table::over`] | inputs of one motion | the motion |
//! | `Table::turn_with_loads`, `Table::over_with_loads` | inputs of one motion | the motion and the loads of a scene in it |
//! | `Table::simulated`, `Table::simulated_at` | steps of a simulation, or times | the motion and the loads |
//!
//! A motion has the columns of its input, `time` if the input moves, of each unknown and each output `psi`, `psi_rate` and
//! `psi_acceleration`, and of each point `C_x`, `C_y`, `C_velocity_x`, `C_velocity_y`, `C_speed`, `C_acceleration_x` and
//! `C_acceleration_y`. [`Table::select`] chooses and orders them, [`Table::degrees`] writes angles in degrees,
//! [`Table::units`] puts units in the heads, [`Table::digits`] rounds what is written, and
//! [`Chart::of`](crate::chart::Chart::of) draws them.

mod column;
mod error;
mod kink;
mod motion;
#[cfg(feature = "dynamics")]
mod scene;
#[cfg(feature = "dynamics")]
mod simulation;
mod write;

pub use column::Units;
pub use error::TableError;
pub use kink::{NEXT_TO_KINK, at_kink};
#[cfg(feature = "dynamics")]
pub(crate) use motion::names;

pub(crate) use column::{Column, Quantity};

use std::fmt;

#[cfg(feature = "dynamics")]
use linkage_dynamics::MotionError;
#[cfg(feature = "dynamics")]
use linkage_runtime::BorrowedName;
use linkage_runtime::PathError;

/// Columns of numbers with names.
///
/// ```
/// linkage::linkage! {
///     pub mechanism FourBar {
///         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
///         input theta2;
///         unknown theta3, theta4;
///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
///         point C = l2@theta2 + l3@theta3;
///     }
/// }
/// use linkage::Table;
/// use linkage::table::Units;
///
/// // A turn in 360 steps, at 10 rad/s.
/// let table = Table::turn(&FourBar::default(), FourBarBranch::new(linkage::Elbow::Left), 360, 10.0)?;
/// let height = table.column("C_y").unwrap();
/// assert!(height.iter().all(|&y| y > 0.0));
///
/// // Some of its columns, for a spreadsheet.
/// let mm = Units { length: "mm", ..Units::SI };
/// let csv = table.select(["theta2", "C_x", "C_velocity_x"])?.degrees().units(mm).digits(6).to_csv();
/// let mut lines = csv.lines();
/// assert_eq!(lines.next(), Some("theta2 [deg],C_x [mm],C_velocity_x [mm/s]"));
/// // The turn closes: its first position is the last row, too.
/// assert_eq!(lines.clone().count(), 361);
/// assert_eq!(lines.next().unwrap().split_once(','), Some(("0", "30,163.299")));
/// assert_eq!(lines.last().unwrap().split_once(','), Some(("360", "30,163.299")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Table {
    columns: Vec<Column>,
    missing: Vec<Missing>,
    marks: Vec<Mark>,
    /// The number of significant digits that are written.
    #[cfg_attr(feature = "serde", serde(skip))]
    digits: Option<usize>,
}

/// A row with cells that have no number.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Missing {
    /// The row, counted from 0; the number of rows where a simulation ended before its end.
    pub row: usize,
    /// Why there is no number.
    pub cause: Cause,
}

/// The reason why a number does not exist.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// The motion has no position or no rate there.
    Path(PathError<String>),
    /// These columns have no number, since a function has a kink there, as `abs(x)` at x = 0.
    Kink(Vec<String>),
    /// The loads cannot be computed there, or the simulation has ended with this error.
    #[cfg(feature = "dynamics")]
    Motion(MotionError<String>),
    /// An event has ended the simulation before.
    #[cfg(feature = "dynamics")]
    Ended,
    /// The rates may jump there: points and outputs have no acceleration.
    #[cfg(feature = "dynamics")]
    Jump,
}

#[cfg(feature = "dynamics")]
impl Cause {
    /// The error of a motion. It owns its names, since a table does.
    fn of_motion<N: BorrowedName>(error: MotionError<N>) -> Self {
        Self::Motion(error.map_names(|name| name.to_string()))
    }
}

/// A place on an axis: an event of a simulation, a change point or an end of a motion.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mark {
    /// The name of the column in which the place is measured.
    pub column: String,
    /// The place.
    pub at: f64,
    /// The name.
    pub name: String,
}

impl Table {
    /// A table without rows.
    pub fn new(names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self::of_columns(names.into_iter().map(|name| (name.into(), Quantity::Plain)))
    }

    /// A table without rows. The second column of a name is that name with `_2`.
    fn of_columns(columns: impl IntoIterator<Item = (String, Quantity)>) -> Self {
        let mut table = Self::default();
        for (name, quantity) in columns {
            let name = table.free_name(name);
            table.columns.push(Column::new(name, quantity));
        }
        table
    }

    fn free_name(&self, name: String) -> String {
        let is_free = |name: &str| self.columns.iter().all(|column| column.name != name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        std::iter::once(name.clone()).chain(numbered).find(|name| is_free(name)).unwrap_or(name)
    }

    /// Adds a row. A number that does not exist is NaN.
    ///
    /// # Panics
    /// If it does not have a number for each name.
    pub fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.columns.len(), "a number for each name");
        for (column, number) in self.columns.iter_mut().zip(row) {
            column.values.push(*number);
        }
    }

    /// Adds a row whose last cells may be missing.
    fn push_partial(&mut self, row: &[f64], cause: Option<Cause>) {
        self.missing.extend(cause.map(|cause| Missing { row: self.len(), cause }));
        let cells = row.iter().copied().chain(std::iter::repeat(f64::NAN));
        for (column, number) in self.columns.iter_mut().zip(cells) {
            column.values.push(number);
        }
    }

    /// Adds a row at a kink, where numbers without a derivative are NaN.
    fn push_kink(&mut self, row: &[f64]) {
        let missing = self.columns.iter().zip(row).filter(|(_, number)| number.is_nan());
        let names: Vec<String> = missing.map(|(column, _)| column.name.clone()).collect();
        let cause = (!names.is_empty()).then_some(Cause::Kink(names));
        self.push_partial(row, cause);
    }

    /// The table with a column at its end, such as an energy at the states of a simulation.
    ///
    /// # Errors
    /// [`TableError::Length`] if it has not a number for each row, [`TableError::SameName`] if there is a column of this
    /// name.
    pub fn with(mut self, name: &str, values: Vec<f64>) -> Result<Self, TableError> {
        if self.columns.iter().any(|column| column.name == name) {
            return Err(TableError::SameName { name: name.to_owned() });
        }
        if !self.columns.is_empty() && values.len() != self.len() {
            return Err(TableError::Length { name: name.to_owned(), numbers: values.len(), rows: self.len() });
        }
        self.columns.push(Column { values, ..Column::new(name.to_owned(), Quantity::Plain) });
        Ok(self)
    }

    /// The number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// True if it has no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The names of the columns.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.name.as_str()).collect()
    }

    /// The numbers of a column, a number for each row; NaN where it does not exist.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
    }

    /// The rows without some or all of their numbers, each with the reason.
    #[must_use]
    pub fn missing(&self) -> &[Missing] {
        &self.missing
    }

    /// The events of a simulation by time; the change points and the ends of a motion by its input.
    #[must_use]
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// The table of some of the columns, in this order.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`], with the nearest name.
    pub fn select(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Self, TableError> {
        let columns = names.into_iter().map(|name| self.find(name.as_ref()).cloned());
        Ok(Self { columns: columns.collect::<Result<_, _>>()?, ..self.clone() })
    }

    /// Writes all angles in degrees, with their rates and accelerations. An output is not known to be an angle: see
    /// [`degrees_of`](Self::degrees_of).
    #[must_use]
    pub fn degrees(mut self) -> Self {
        let angles: Vec<usize> = (0..self.columns.len()).filter(|&place| self.columns[place].is_angle()).collect();
        self.turn_to_degrees(&angles);
        self
    }

    /// Writes these columns in degrees, with their columns `_rate` and `_acceleration`.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`], and [`TableError::NotAnAngle`] for a length, a time or a force.
    pub fn degrees_of(mut self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Self, TableError> {
        for name in names {
            let places = self.family(name.as_ref())?;
            self.turn_to_degrees(&places);
        }
        Ok(self)
    }

    /// Lets an output that is an angle go on where its formula jumps, by a whole turn where an `atan2` goes from pi to -pi: each
    /// row is on the turn nearest to the last one, with the columns of its rate and of `time` if there are such.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`].
    pub fn on_turns(mut self, name: &str, jump: f64) -> Result<Self, TableError> {
        self.find(name)?;
        let column = |name: &str| self.column(name).map(<[f64]>::to_vec).unwrap_or_default();
        let (times, rates) = (column("time"), column(&format!("{name}_rate")));
        let turning = |from: usize, to: usize| {
            let of = |all: &[f64], row: usize| all.get(row).copied();
            let (before, after) = (of(&rates, from)?, of(&rates, to)?);
            let moved = (before + after) / 2.0 * (of(&times, to)? - of(&times, from)?);
            moved.is_finite().then_some(moved)
        };
        let Some(column) = self.columns.iter_mut().find(|column| column.name == name) else { return Ok(self) };
        let mut last: Option<(usize, f64)> = None;
        for (row, value) in column.values.iter_mut().enumerate().filter(|(_, value)| value.is_finite()) {
            if let Some((before, from)) = last {
                let expected = from + turning(before, row).unwrap_or_default();
                *value += ((expected - *value) / jump).round() * jump;
            }
            last = Some((row, *value));
        }
        Ok(self)
    }

    /// Says that these columns are angles in radians, such as outputs, with their columns `_rate` and `_acceleration`: a chart has
    /// them in degrees. The numbers remain.
    ///
    /// # Errors
    /// Those of [`degrees_of`](Self::degrees_of).
    pub fn angles_of(mut self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Self, TableError> {
        for name in names {
            self.family(name.as_ref())?;
        }
        Ok(self)
    }

    /// The columns of an angle, its rate and its acceleration.
    fn family(&mut self, name: &str) -> Result<Vec<usize>, TableError> {
        if !self.find(name)?.may_be_angle() {
            return Err(TableError::NotAnAngle { name: name.to_owned() });
        }
        let mut places = Vec::new();
        for (order, end) in (0..).zip(["", "_rate", "_acceleration"]) {
            let name = format!("{name}{end}");
            let Some(place) = self.columns.iter().position(|column| column.name == name) else { continue };
            if self.columns[place].quantity == Quantity::Plain {
                self.columns[place].quantity = Quantity::Angle(order);
            }
            places.push(place);
        }
        Ok(places)
    }

    fn turn_to_degrees(&mut self, places: &[usize]) {
        for &place in places {
            let column = &mut self.columns[place];
            if !column.turn_to_degrees() {
                continue;
            }
            for mark in self.marks.iter_mut().filter(|mark| mark.column == column.name) {
                mark.at = mark.at.to_degrees();
            }
        }
    }

    /// Writes units in the heads: `C_x [mm]`. The numbers remain: the units are those in which the mechanism was given.
    /// Outputs and forces of contacts have none, see [`unit`](Self::unit).
    #[must_use]
    pub fn units(mut self, units: Units<'_>) -> Self {
        for column in &mut self.columns {
            column.unit = column.quantity.unit(Some(units)).or(column.unit.take());
        }
        self
    }

    /// Writes this unit in the head of a column, such as an output. The numbers remain.
    ///
    /// # Errors
    /// [`TableError::UnknownColumn`].
    pub fn unit(mut self, name: &str, unit: &str) -> Result<Self, TableError> {
        self.find(name)?;
        for column in self.columns.iter_mut().filter(|column| column.name == name) {
            column.unit = Some(unit.to_owned());
        }
        Ok(self)
    }

    /// Writes numbers with at most so many significant digits, at least 1. By default each has as many as it needs to read
    /// back as the same double.
    #[must_use]
    pub fn digits(self, digits: usize) -> Self {
        Self { digits: Some(digits.max(1)), ..self }
    }

    /// The column of this name.
    pub(crate) fn find(&self, name: &str) -> Result<&Column, TableError> {
        self.columns.iter().find(|column| column.name == name).ok_or_else(|| TableError::unknown(name, &self.names()))
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Path(error) => error.fmt(f),
            Self::Kink(columns) => write!(f, "a kink, where there is no {}", columns.join(", ")),
            #[cfg(feature = "dynamics")]
            Self::Motion(error) => error.fmt(f),
            #[cfg(feature = "dynamics")]
            Self::Ended => f.write_str("an event has ended the simulation before"),
            #[cfg(feature = "dynamics")]
            Self::Jump => f.write_str("the rates may jump: points and outputs have no acceleration"),
        }
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Cause {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
