//! Values: the operations of lowered code.

use super::id::{Signed, ValueId};
use super::statement::{Block, Pattern};
use crate::graph::{External, ExternalId, Function, NodeId, Number, SymbolId};
use crate::ids::FunctionId;
use crate::program::{Constant, Intrinsic, Receiver, Type};

/// The operation that computes a value. A value that a statement binds is computed there, any other where it is used.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Value {
    // Bound by a statement, or given.
    Symbol(SymbolId),
    /// The sine or cosine of an angle with known direction.
    Direction(Function, NodeId),
    /// A part of another value, a result of a step, or an argument of an inner function.
    Bound,
    /// `self`
    Itself,
    /// An argument of the function, by its index.
    Argument(usize),

    // Arithmetic. Until signs are settled, a value may stand for its negative, whose sign the sums and results that use it
    // keep.
    Constant(Number),
    /// A number of any kind, to which no double is close enough.
    Exact(Number),
    Sum(Vec<Signed>),
    Product(Vec<ValueId>),
    Quotient(ValueId, ValueId),
    Square(ValueId),
    Negative(ValueId),
    Call(Function, Vec<Signed>),
    /// A user function or a derivative of it, which a [`UserFunction`](Self::UserFunction) returns.
    External(External, Vec<Signed>),
    /// All conditions, none of them left out.
    All(Vec<ValueId>),

    // Data.
    Text(String),
    Count(usize),
    Path(Constant),
    Field(ValueId, String),
    Index(ValueId, usize),
    /// The entry of a list at a number that is known when the function runs.
    At(ValueId, ValueId),
    List(Vec<ValueId>),
    /// `[value; count]`
    Repeated(ValueId, usize),
    Tuple(Vec<ValueId>),
    /// `Type { field: value, ..rest }`
    Struct(Type, Vec<(String, ValueId)>, Option<ValueId>),

    // Calls.
    Intrinsic(Intrinsic, Option<Type>, Vec<ValueId>),
    /// A function as a value.
    Function(Intrinsic, Option<Type>),
    /// A call of a function of the program: of the driver if the receiver is a value or a type.
    Own(Receiver<ValueId>, FunctionId, Vec<ValueId>),
    /// A call of a user function, which returns its value and its derivatives.
    UserFunction(ExternalId, Vec<ValueId>),
    /// `value?`
    Try(ValueId),
    /// `&value`
    Borrowed(ValueId),
    /// `&mut value`
    MutablyBorrowed(ValueId),
    /// `*value`
    Dereferenced(ValueId),
    /// `|arguments| { … }`, with `move` if `moves`.
    Closure {
        arguments: Vec<Pattern>,
        body: Block,
        moves: bool,
    },
    /// `{ … }`
    Block(Block),
}

impl Value {
    /// True for the sine or cosine of an angle that is a symbol, as in the components of links; that of a difference of
    /// angles belongs to a determinant.
    pub(super) fn is_circular(&self, values: &[Value]) -> bool {
        match self {
            Self::Direction(..) => true,
            Self::Call(Function::Sin | Function::Cos, angle) => {
                angle.iter().all(|angle| matches!(values[angle.value.0], Self::Symbol(_)))
            }
            _ => false,
        }
    }

    /// Visits the operands, without the statements of inner functions and blocks.
    pub fn each_part(&self, mut visit: impl FnMut(ValueId)) {
        match self {
            Self::Symbol(_)
            | Self::Direction(..)
            | Self::Bound
            | Self::Itself
            | Self::Argument(_)
            | Self::Constant(_)
            | Self::Exact(_)
            | Self::Text(_)
            | Self::Count(_)
            | Self::Path(_)
            | Self::Function(..)
            | Self::Closure { .. }
            | Self::Block(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) | Self::External(_, parts) => {
                parts.iter().for_each(|part| visit(part.value));
            }
            Self::Product(all)
            | Self::All(all)
            | Self::List(all)
            | Self::Tuple(all)
            | Self::Intrinsic(_, _, all)
            | Self::UserFunction(_, all) => all.iter().copied().for_each(visit),
            Self::Quotient(above, below) | Self::At(above, below) => {
                visit(*above);
                visit(*below);
            }
            Self::Square(of)
            | Self::Negative(of)
            | Self::Field(of, _)
            | Self::Index(of, _)
            | Self::Repeated(of, _)
            | Self::Try(of)
            | Self::Borrowed(of)
            | Self::MutablyBorrowed(of)
            | Self::Dereferenced(of) => visit(*of),
            Self::Struct(_, members, rest) => {
                members.iter().for_each(|(_, value)| visit(*value));
                rest.iter().copied().for_each(visit);
            }
            Self::Own(receiver, _, arguments) => {
                if let Receiver::Value(of) = receiver {
                    visit(*of);
                }
                arguments.iter().copied().for_each(visit);
            }
        }
    }

    /// The value with other operands, which are not in statements of inner functions and blocks.
    pub(super) fn with_operands(mut self, of: &mut dyn FnMut(ValueId) -> ValueId) -> Self {
        let mut change = |id: &mut ValueId| *id = of(*id);
        match &mut self {
            Self::Symbol(_)
            | Self::Direction(..)
            | Self::Bound
            | Self::Itself
            | Self::Argument(_)
            | Self::Constant(_)
            | Self::Exact(_)
            | Self::Text(_)
            | Self::Count(_)
            | Self::Path(_)
            | Self::Function(..)
            | Self::Closure { .. }
            | Self::Block(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) | Self::External(_, parts) => {
                parts.iter_mut().for_each(|part| change(&mut part.value));
            }
            Self::Product(all)
            | Self::All(all)
            | Self::List(all)
            | Self::Tuple(all)
            | Self::Intrinsic(_, _, all)
            | Self::UserFunction(_, all) => all.iter_mut().for_each(change),
            Self::Quotient(above, below) | Self::At(above, below) => {
                change(above);
                change(below);
            }
            Self::Square(of)
            | Self::Negative(of)
            | Self::Field(of, _)
            | Self::Index(of, _)
            | Self::Repeated(of, _)
            | Self::Try(of)
            | Self::Borrowed(of)
            | Self::MutablyBorrowed(of)
            | Self::Dereferenced(of) => change(of),
            Self::Struct(_, members, rest) => {
                members.iter_mut().for_each(|(_, value)| change(value));
                rest.iter_mut().for_each(change);
            }
            Self::Own(receiver, _, arguments) => {
                if let Receiver::Value(of) = receiver {
                    change(of);
                }
                arguments.iter_mut().for_each(change);
            }
        }
        self
    }
}
