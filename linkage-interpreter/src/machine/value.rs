//! Values of running code.

use std::cell::RefCell;
use std::fmt::Debug;
use std::rc::Rc;
use std::sync::Arc;

use linkage_ir::{Name, ValueId};
use linkage_runtime::__rt::{Memory, NearestTurns, Wide};
use linkage_runtime::AssemblyMode;

use super::defect::Defect;
use crate::error::Error;
use crate::tape::{Flag, Traced};

/// A value. Lists stand for arrays, tuples, columns and the columns of matrices, and a direction is the list of its cosine
/// and its sine.
#[derive(Debug, Clone, Default)]
pub(crate) enum Value {
    Number(f64),
    Wide(Wide),
    /// A register of a tape.
    Traced(Traced),
    Flag(bool),
    TracedFlag(Flag),
    Count(i64),
    Text(Arc<str>),
    List(Rc<[Value]>),
    /// The columns of a matrix.
    Matrix(Rc<[Value]>),
    Record(Rc<Record>),
    /// A value that may be absent and is; one that is present is itself.
    #[default]
    Absent,
    Outcome(Rc<Result<Value, Error>>),
    /// The solution of the positive root, or that of the negative one.
    Side(bool),
    Mode(AssemblyMode),
    /// A function without a name, by its value.
    Closure(ValueId),
    /// The inputs of a position, for errors.
    At(Rc<[f64]>),
    Turns(Rc<Turning>),
    Factors(Rc<dyn Factors>),
    Memory(Rc<RefCell<Option<Kept>>>),
    Modes(Rc<dyn Found>),
}

/// The source of the turns of angles, by place.
#[derive(Debug)]
pub(crate) enum Turning {
    Given(Vec<i32>),
    Nearest(Vec<RefCell<Nearest>>),
}

/// The turn of an angle that is nearest to a guess, of one position or of lanes.
#[derive(Debug)]
pub(crate) enum Nearest {
    One(NearestTurns<f64, 1>),
    Traced(Traced),
}

/// A factorised matrix of any size and scalar.
pub(crate) trait Factors: Debug {
    fn solve(&self, right: &Value) -> Result<Value, Defect>;
    /// True if a solution loses digits that twice the precision keeps.
    fn loses_digits(&self) -> bool;
}

/// All positions of a group.
pub(crate) trait Found: Debug {
    fn take(&self, names: [&Arc<str>; 2], mode: AssemblyMode) -> Result<Value, Error>;
}

/// The positions of a group that were found last, by the number of its loops.
#[derive(Debug, Clone)]
pub(crate) enum Kept {
    Two(Box<Memory<f64, 2, 4>>),
    Three(Box<Memory<f64, 3, 6>>),
}

/// Fields by name.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    /// The type of the runtime that it is; nothing of other types.
    pub(crate) of: &'static str,
    pub(crate) fields: Vec<(Name, Value)>,
}

impl Record {
    pub(crate) fn get(&self, name: Name) -> Option<&Value> {
        self.fields.iter().find(|(other, _)| *other == name).map(|(_, value)| value)
    }
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Wide> for Value {
    fn from(value: Wide) -> Self {
        Self::Wide(value)
    }
}

impl Value {
    pub(crate) fn list(values: impl IntoIterator<Item = Self>) -> Self {
        Self::List(values.into_iter().collect())
    }

    pub(crate) fn record(fields: impl IntoIterator<Item = (Name, Self)>) -> Self {
        Self::Record(Rc::new(Record { of: "", fields: fields.into_iter().collect() }))
    }

    pub(crate) fn outcome(outcome: Result<Self, Error>) -> Self {
        Self::Outcome(Rc::new(outcome))
    }

    /// The value of no meaning, `()`.
    pub(crate) fn unit() -> Self {
        Self::List(Rc::default())
    }

    /// The value is not of the form that it must have.
    #[cold]
    pub(crate) fn expected(&self, what: &str) -> Defect {
        let found = match self {
            Self::Number(_) | Self::Wide(_) | Self::Traced(_) => "a number",
            Self::Flag(_) | Self::TracedFlag(_) => "a flag",
            Self::Count(_) => "a count",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Matrix(_) => "a matrix",
            Self::Record(_) => "fields",
            Self::Absent => "no value",
            Self::Outcome(_) => "an outcome",
            Self::Side(_) => "a side",
            Self::Mode(_) => "a number of a mode",
            Self::Closure(_) => "a function",
            Self::At(_) => "a place",
            Self::Turns(_) => "turns",
            Self::Factors(_) => "factors",
            Self::Memory(_) => "a memory",
            Self::Modes(_) => "modes",
        };
        Defect::new(format!("expected {what}, found {found}"))
    }

    pub(crate) fn as_list(&self) -> Result<&[Self], Defect> {
        match self {
            Self::List(all) | Self::Matrix(all) => Ok(all),
            other => Err(other.expected("a list")),
        }
    }

    pub(crate) fn as_record(&self) -> Result<&Record, Defect> {
        match self {
            Self::Record(record) => Ok(record),
            other => Err(other.expected("fields")),
        }
    }

    pub(crate) fn as_text(&self) -> Result<&Arc<str>, Defect> {
        match self {
            Self::Text(text) => Ok(text),
            other => Err(other.expected("a text")),
        }
    }

    pub(crate) fn as_flag(&self) -> Result<bool, Defect> {
        match self {
            Self::Flag(flag) => Ok(*flag),
            other => Err(other.expected("a flag")),
        }
    }

    pub(crate) fn as_count(&self) -> Result<usize, Defect> {
        match self {
            Self::Count(count) => usize::try_from(*count).map_err(|_| self.expected("a count")),
            other => Err(other.expected("a count")),
        }
    }

    /// A field of a record, or a part of a direction or a point.
    pub(crate) fn field(&self, name: Name) -> Result<&Self, Defect> {
        let found = match self {
            Self::Record(record) => record.get(name),
            Self::List(parts) => match name {
                Name::RE | Name::X => parts.first(),
                Name::IM | Name::Y => parts.get(1),
                _ => None,
            },
            _ => None,
        };
        found.ok_or_else(|| self.expected("a field"))
    }

    /// Visits the numbers, flags and counts in it, in order.
    pub(crate) fn each_leaf<'v>(&'v self, visit: &mut dyn FnMut(&'v Self)) {
        match self {
            Self::List(all) | Self::Matrix(all) => all.iter().for_each(|value| value.each_leaf(visit)),
            Self::Record(record) => record.fields.iter().for_each(|(_, value)| value.each_leaf(visit)),
            leaf => visit(leaf),
        }
    }

    /// The value with other leaves.
    pub(crate) fn map_leaves(&self, other: &mut dyn FnMut(&Self) -> Self) -> Self {
        match self {
            Self::List(all) => Self::list(all.iter().map(|value| value.map_leaves(other))),
            Self::Matrix(all) => Self::Matrix(all.iter().map(|value| value.map_leaves(other)).collect()),
            Self::Record(record) => {
                let fields = record.fields.iter().map(|(name, value)| (*name, value.map_leaves(other)));
                Self::Record(Rc::new(Record { of: record.of, fields: fields.collect() }))
            }
            leaf => other(leaf),
        }
    }
}
