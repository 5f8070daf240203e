//! Lowered code: values by id, and the statements that bind them in order.

use std::collections::{BTreeMap, BTreeSet};

use super::id::ValueId;
use super::rounding::Bound;
use super::statement::Statement;
use super::value::Value;
use crate::graph::ExternalId;
use crate::ids::FunctionId;
use crate::program::Operations;

/// The lowered body of a function.
#[derive(Debug, Clone)]
pub struct Code {
    pub(super) values: Vec<Value>,
    pub statements: Vec<Statement>,
    pub value: Returned,
    pub operations: Operations,
    /// The arguments that it uses, by index.
    pub uses: BTreeSet<usize>,
    /// The user functions that it calls.
    pub externals: BTreeSet<ExternalId>,
    /// True if its formulas need no iteration, no pivoting and no function of the user or of a library.
    pub is_branch_free: bool,
    /// The largest rounding errors that its results can have, if they are known.
    pub bound: Option<Bound>,
    pub(super) names: Names,
}

/// Names for readers.
#[derive(Debug, Clone, Default)]
pub(super) struct Names {
    /// Those of the values that statements bind, and of arguments.
    pub(super) values: Vec<Option<String>>,
    pub(super) functions: BTreeMap<Callee, Called>,
}

/// The name of a function that code calls.
#[derive(Debug, Clone)]
pub struct Called {
    pub name: String,
    /// True for a function of the trait `Mechanism`.
    pub is_of_mechanism: bool,
}

/// A function that the program defines or takes from the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Callee {
    /// One of the same type.
    Own(FunctionId),
    /// One of the driver of a scene.
    OfDriver(FunctionId),
    User(ExternalId),
}

/// The value that a function returns.
#[derive(Debug, Clone, Copy)]
pub enum Returned {
    /// A value; in a fallible function it is wrapped in `Ok`.
    Plain(ValueId),
    /// The `Result` of another function.
    Result(ValueId),
    /// The `Result` in a variable that holds a literal, whose members are assigned.
    Stored { result: ValueId, literal: ValueId },
}

impl Returned {
    /// The expression that the function returns.
    pub fn returned(self) -> ValueId {
        match self {
            Self::Plain(value) | Self::Result(value) | Self::Stored { result: value, .. } => value,
        }
    }

    /// The value by its members.
    pub fn literal(self) -> ValueId {
        match self {
            Self::Plain(value) | Self::Result(value) | Self::Stored { literal: value, .. } => value,
        }
    }
}

impl Code {
    /// The operation that computes a value.
    pub fn operation(&self, id: ValueId) -> &Value {
        &self.values[id.0]
    }

    /// The name of a value that a statement binds, or of an argument.
    pub fn name(&self, id: ValueId) -> Option<&str> {
        self.names.values.get(id.0)?.as_deref()
    }

    /// The name of a function that it calls.
    pub fn callee(&self, of: Callee) -> Option<&Called> {
        self.names.functions.get(&of)
    }
}

impl Statement {
    /// True if it may end the function.
    pub(super) fn may_return(&self, values: &[Value]) -> bool {
        match self {
            Self::Let(_, value) | Self::Do(value) => matches!(values[value.0], Value::Try(_)),
            Self::LetElse(..) | Self::Unless(..) | Self::Return(_) => true,
            Self::Assign(..) => false,
        }
    }
}
