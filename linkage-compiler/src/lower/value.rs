//! Values and statements of code that is being ordered: as those of compiled code, but what is given has no slot yet.

use linkage_ir::ValueId;
use linkage_ir::code;
use linkage_ir::code::Given;

use crate::graph::{External, Function, NodeId, SymbolId};

pub use linkage_ir::code::Signed;

/// The operation that computes a value. A value that a statement binds is computed there, any other where it is used. Until
/// signs are settled, a value may stand for its negative, whose sign the sums and results that use it keep.
pub type Value = code::Value<Leaf, ValueId>;
/// A statement.
pub type Statement = code::Statement<ValueId>;
/// A pattern that binds values. One that binds the value of its own statement gives it a name.
pub type Pattern = code::Pattern<ValueId>;
/// Statements and a value.
pub type Block = code::Block<ValueId>;

/// A value that a statement binds, or an argument.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Leaf {
    Symbol(SymbolId),
    /// The sine or cosine of an angle with known direction.
    Direction(Function, NodeId),
    /// A part of another value, a result of a step, or an argument of an inner function.
    Bound,
    /// `self`
    Itself,
    /// An argument of the function, by its index.
    Argument(usize),
    /// A user function or a derivative of it, which a call of the user function returns.
    External(External, Vec<Signed>),
}

impl Given for Leaf {
    fn each_part(&self, visit: &mut dyn FnMut(ValueId)) {
        if let Self::External(_, parts) = self {
            parts.iter().for_each(|part| visit(part.value));
        }
    }

    fn change_parts(&mut self, change: &mut dyn FnMut(&mut ValueId)) {
        if let Self::External(_, parts) = self {
            parts.iter_mut().for_each(|part| change(&mut part.value));
        }
    }
}

/// True for the sine or cosine of an angle that is a symbol, as in the components of links; that of a difference of angles
/// belongs to a determinant.
pub(super) fn is_circular(value: &Value, values: &[Value]) -> bool {
    match value {
        Value::Given(Leaf::Direction(..)) => true,
        Value::Call(Function::Sin | Function::Cos, angle) => {
            angle.iter().all(|angle| matches!(values[angle.value.index()], Value::Given(Leaf::Symbol(_))))
        }
        _ => false,
    }
}

/// The value with other operands, which are not in statements of inner functions and blocks.
pub(super) fn with_operands(mut value: Value, of: &mut dyn FnMut(ValueId) -> ValueId) -> Value {
    value.change_parts(&mut |id| *id = of(*id));
    value
}

/// The values that a statement binds.
pub(super) fn bound_by(statement: &Statement) -> Vec<ValueId> {
    let mut bound = Vec::new();
    if let Some(pattern) = statement.pattern() {
        pattern.each(&mut |value| bound.push(*value));
    }
    bound
}
