//! Values: the operations of straight-line code.

use crate::graph::{External, Function, NodeId, Number, SymbolId};

/// A value of straight-line code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ValueId(pub(super) usize);

/// A value or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Signed {
    pub negative: bool,
    pub value: ValueId,
}

/// The operation that computes a value; its sign is kept by the sums and results that use it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Value {
    Symbol(SymbolId),
    /// The sine or cosine of an angle with known direction.
    Direction(Function, NodeId),
    Constant(Number),
    Sum(Vec<Signed>),
    Product(Vec<ValueId>),
    Quotient(ValueId, ValueId),
    Square(ValueId),
    Call(Function, Vec<Signed>),
    /// A user function or a derivative of it.
    External(External, Vec<Signed>),
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

    pub(super) fn each_part(&self, mut visit: impl FnMut(ValueId)) {
        match self {
            Self::Symbol(_) | Self::Direction(..) | Self::Constant(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) | Self::External(_, parts) => {
                for part in parts {
                    visit(part.value);
                }
            }
            Self::Product(factors) => {
                for factor in factors {
                    visit(*factor);
                }
            }
            Self::Quotient(above, below) => {
                visit(*above);
                visit(*below);
            }
            Self::Square(base) => visit(*base),
        }
    }
}
