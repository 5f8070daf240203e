//! The declared things of a mechanism as plain data: names, kinds and defaults, without the tokens that they are written in.

use crate::graph::{ExternalId, Graph};
use crate::ids::{CoordinateId, Table};
use crate::model::{self, Kind, Mechanism};

/// A name, as the user wrote it and as the name of a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Name {
    pub text: String,
    pub field: String,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    pub name: Name,
    /// The value of its default, if it has one that is a number.
    pub default: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coordinate {
    pub name: Name,
    pub is_angle: bool,
}

/// A user function: the names of its value and its derivatives, and the number of its arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UserFunction {
    pub id: ExternalId,
    pub names: Vec<String>,
    pub arguments: usize,
}

impl From<&model::Name> for Name {
    fn from(of: &model::Name) -> Self {
        Self { text: of.text.clone(), field: of.field.clone() }
    }
}

impl Parameter {
    pub(in crate::program) fn of(graph: &Graph, of: &model::Parameter) -> Self {
        let value =
            |node| graph.as_number(node).map(crate::graph::Number::to_f64).or_else(|| graph.constant_value(node));
        Self { name: (&of.name).into(), default: of.default.and_then(value) }
    }
}

impl Coordinate {
    /// The coordinates with these ids.
    pub(super) fn all<I>(mechanism: &Mechanism, ids: &Table<I, CoordinateId>) -> Table<I, Self> {
        let of = |id: &CoordinateId| &mechanism.coordinates[*id];
        ids.iter().map(of).map(|of| Self { name: (&of.name).into(), is_angle: of.kind == Kind::Angle }).collect()
    }
}

impl From<&model::ExternalFunction> for UserFunction {
    fn from(of: &model::ExternalFunction) -> Self {
        Self {
            id: of.id,
            names: of.names.iter().map(|name| name.text.clone()).collect(),
            arguments: of.arguments.len(),
        }
    }
}
