//! Values of running code.

use std::cell::RefCell;
use std::fmt::Debug;
use std::rc::Rc;
use std::sync::Arc;

use linkage_runtime::__rt::Wide;
use linkage_runtime::AssemblyMode;

use super::failure::{Defect, Error};
use super::groups::{Factors, Found, Kept};
use super::turns::Turning;
use crate::code::{Id, Name};
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
    /// A function without a name, by its expression.
    Closure(Id),
    /// The inputs of a position, for errors.
    At(Rc<[f64]>),
    Turns(Rc<Turning>),
    Factors(Rc<dyn Factors>),
    Memory(Rc<RefCell<Option<Kept>>>),
    Modes(Rc<dyn Found>),
}

/// Fields by name.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    /// The type.
    pub(crate) of: Name,
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

    pub(crate) fn record(of: Name, fields: impl IntoIterator<Item = (Name, Self)>) -> Self {
        Self::Record(Rc::new(Record { of, fields: fields.into_iter().collect() }))
    }

    pub(crate) fn outcome(outcome: Result<Self, Error>) -> Self {
        Self::Outcome(Rc::new(outcome))
    }

    /// The value of no meaning, `()`.
    pub(crate) fn unit() -> Self {
        Self::List(Rc::default())
    }

    pub(crate) fn as_list(&self) -> Result<&[Self], Defect> {
        match self {
            Self::List(all) | Self::Matrix(all) => Ok(all),
            other => Err(Defect::expected("a list", other)),
        }
    }

    pub(crate) fn as_record(&self) -> Result<&Record, Defect> {
        match self {
            Self::Record(record) => Ok(record),
            other => Err(Defect::expected("fields", other)),
        }
    }

    pub(crate) fn as_text(&self) -> Result<&Arc<str>, Defect> {
        match self {
            Self::Text(text) => Ok(text),
            other => Err(Defect::expected("a text", other)),
        }
    }

    pub(crate) fn as_flag(&self) -> Result<bool, Defect> {
        match self {
            Self::Flag(flag) => Ok(*flag),
            other => Err(Defect::expected("a flag", other)),
        }
    }

    pub(crate) fn as_count(&self) -> Result<usize, Defect> {
        match self {
            Self::Count(count) => usize::try_from(*count).map_err(|_| Defect::expected("a count", self)),
            other => Err(Defect::expected("a count", other)),
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
        found.ok_or_else(|| Defect::expected("a field", self))
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
                Self::record(record.of, record.fields.iter().map(|(name, value)| (*name, value.map_leaves(other))))
            }
            leaf => other(leaf),
        }
    }
}
