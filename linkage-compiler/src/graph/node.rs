//! What a graph is made of: nodes and names by number, and what may be wrong or taken for granted.

use super::{External, Function, Number};
use crate::places::Hash;

/// An expression of a [`Graph`](super::Graph).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(super) u32);

/// A name of a [`Graph`](super::Graph): parameter, coordinate, rate, or a quantity solved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SymbolId(pub(super) u32);

/// What an expression is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
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
    /// A function of the user's, or a derivative of it.
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

/// What was taken for granted when something was cancelled: where it fails, the expression as
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

impl SymbolId {
    /// No symbol at all.
    pub const NONE: Self = Self(u32::MAX);

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

impl NodeId {
    pub(super) fn new(index: usize) -> Self {
        Self(u32::try_from(index).unwrap_or(u32::MAX))
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

impl Node {
    /// How many parts it has.
    pub(super) fn parts(&self) -> usize {
        match self {
            Self::Constant(_) | Self::Pi | Self::Symbol(_) => 0,
            Self::Sum { terms, .. } => terms.len(),
            Self::Product { factors, .. } => factors.len(),
            Self::Call(_, arguments) | Self::External(_, arguments) => arguments.len(),
        }
    }

    pub(super) fn hash(&self) -> Hash {
        match self {
            Self::Constant(number) => number.hashed(Hash::of(0)),
            Self::Pi => Hash::of(1),
            Self::Symbol(symbol) => Hash::of(2).with(u64::from(symbol.0)),
            Self::Sum { constant, terms } => {
                let mut hash = constant.hashed(Hash::of(3));
                for (coefficient, term) in terms {
                    hash = coefficient.hashed(hash).with(u64::from(term.0));
                }
                hash
            }
            Self::Product { coefficient, factors } => {
                let mut hash = coefficient.hashed(Hash::of(4));
                for (base, exponent) in factors {
                    hash = hash.with(u64::from(base.0) << 32 | u64::from(exponent.cast_unsigned()));
                }
                hash
            }
            Self::Call(function, arguments) => {
                let mut hash = Hash::of(5).with(*function as u64);
                for argument in arguments {
                    hash = hash.with(u64::from(argument.0));
                }
                hash
            }
            Self::External(external, arguments) => {
                let mut hash = Hash::of(6).with(external.function.index() as u64);
                for &times in &external.by {
                    hash = hash.with(u64::from(times));
                }
                for argument in arguments {
                    hash = hash.with(u64::from(argument.0));
                }
                hash
            }
        }
    }
}
