//! The code of a function before its values have slots: values by id, and the statements that bind them in order.

use std::collections::BTreeSet;

use linkage_ir::ValueId;
use linkage_ir::code::Returned;

use super::rounding::Bound;
use super::value::{Statement, Value};
use crate::graph::ExternalId;
use crate::program::Operations;

/// The lowered body of a function, whose operands may come later than what they are operands of.
#[derive(Debug, Clone)]
pub struct Draft {
    pub(super) values: Vec<Value>,
    pub(super) statements: Vec<Statement>,
    pub(super) value: Returned,
    pub(super) operations: Operations,
    /// The arguments that it uses, by index.
    pub(super) uses: BTreeSet<usize>,
    /// The user functions that it calls.
    pub(super) externals: BTreeSet<ExternalId>,
    /// True if its formulas need no iteration, no pivoting and no function of the user or of a library.
    pub(super) is_branch_free: bool,
    /// The largest rounding errors that its results can have, if they are known.
    pub(super) bound: Option<Bound>,
    pub(super) names: Names,
}

/// Names for readers: those of the values that statements bind, and of arguments.
pub(super) type Names = Vec<Option<String>>;

impl Draft {
    /// The operation that computes a value.
    pub(super) fn operation(&self, id: ValueId) -> &Value {
        &self.values[id.index()]
    }

    /// The name of a value that a statement binds, or of an argument.
    pub(super) fn name(&self, id: ValueId) -> Option<&str> {
        self.names.get(id.index())?.as_deref()
    }
}

/// True if a statement may end the function.
pub(super) fn may_return(statement: &Statement, values: &[Value]) -> bool {
    match statement {
        Statement::Let(_, value) | Statement::Do(value) => matches!(values[value.index()], Value::Try(_)),
        Statement::LetElse(..) | Statement::Unless(..) | Statement::Return(_) => true,
        Statement::Assign(..) => false,
        Statement::Store(inside) => may_return(inside, values),
    }
}
