//! Nodes and their ids, faults, and the conditions under which a shorter expression is equal.

use super::{External, Function, Number};

/// An expression of a [`Graph`](super::Graph).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(super) usize);

/// A name of a [`Graph`](super::Graph): parameter, coordinate, rate, or a quantity solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SymbolId(pub(super) usize);

/// An expression in terms of others.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    Constant(Number),
    Pi,
    Symbol(SymbolId),
    /// constant + sum of coefficient * term; terms ascend, no coefficient is zero, no term is
    /// itself a constant, a product with a coefficient or a sum, but for long ones.
    Sum {
        constant: Number,
        terms: Vec<(Number, NodeId)>,
    },
    /// coefficient * product of base^exponent; bases ascend, no exponent is zero, no base is
    /// itself a product, but for parts of long ones.
    Product {
        coefficient: Number,
        factors: Vec<(NodeId, i32)>,
    },
    Call(Function, Vec<NodeId>),
    /// A user function, or a derivative of it.
    External(External, Vec<NodeId>),
}

/// Why an expression has no value at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    DivisionByZero,
    /// A constant that is not zero and not a normal number of `f64`.
    OutOfRange,
    ExponentOverflow,
}

/// A condition that was assumed when something was cancelled: where it fails, the expression as
/// written has no value although the shorter one may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Condition {
    /// x / x = 1
    NonZero(NodeId),
    /// f - f = 0, 0 f = 0
    Defined(NodeId),
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::DivisionByZero => "this divides by zero",
            Self::OutOfRange => "this constant is beyond the range of `f64`, 2.3e-308 to 1.7e308",
            Self::ExponentOverflow => "this exponent is too large",
        })
    }
}

impl NodeId {
    pub(crate) fn index(self) -> usize {
        self.0
    }
}

impl Node {
    /// The number of its parts.
    pub(super) fn parts(&self) -> usize {
        match self {
            Self::Constant(_) | Self::Pi | Self::Symbol(_) => 0,
            Self::Sum { terms, .. } => terms.len(),
            Self::Product { factors, .. } => factors.len(),
            Self::Call(_, arguments) | Self::External(_, arguments) => arguments.len(),
        }
    }
}
