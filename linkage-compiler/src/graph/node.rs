//! Nodes and their ids, faults, and the conditions that simplifications assume.

use super::{Function, Number};

pub use linkage_ir::ExternalId;

/// An expression of a [`Graph`](super::Graph).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(super) usize);

/// A symbol of a [`Graph`](super::Graph): a parameter, a coordinate, a rate, or a result of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SymbolId(pub(super) usize);

/// A user function, or a derivative of it.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct External {
    pub function: ExternalId,
    /// The order of the derivative by each of its arguments.
    pub by: Vec<usize>,
}

/// An expression in terms of others.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    Constant(Number),
    Pi,
    Symbol(SymbolId),
    /// constant + sum of coefficient * term. Terms ascend, no coefficient is zero, and no term is
    /// a constant, a product with a coefficient or a sum, except for long sums.
    Sum {
        constant: Number,
        terms: Vec<(Number, NodeId)>,
    },
    /// coefficient * product of base^exponent. Bases ascend, no exponent is zero, and no base is
    /// a product, except in long products.
    Product {
        coefficient: Number,
        factors: Vec<(NodeId, i32)>,
    },
    Call(Function, Vec<NodeId>),
    /// A user function, or a derivative of it.
    External(External, Vec<NodeId>),
}

/// The reason why an expression has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    DivisionByZero,
    /// 0^0.
    ZeroToZero,
    /// A function of a number outside of its domain, or at its pole.
    Undefined(Function),
    /// A constant that is neither zero nor a normal `f64`.
    OutOfRange,
    /// An exponent beyond [`LARGEST_EXPONENT`].
    ExponentOverflow,
}

/// The largest magnitude of an exponent. A power loses as many bits as its exponent has: with 20 of 53 there is a value
/// left. Derivatives add exponents, and the bound of a rounding error multiplies them: the results stay in
/// the range of `i32`.
pub const LARGEST_EXPONENT: i32 = 1 << 20;

/// A condition that a cancellation assumes: where it fails, the original expression is undefined, although the
/// simplified one may have a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Condition {
    /// x / x = 1
    NonZero(NodeId),
    /// f - f = 0, 0 f = 0
    Defined(NodeId),
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::DivisionByZero => f.write_str("division by zero"),
            Self::ZeroToZero => f.write_str("zero to the power zero has no value: write `1` or `0`"),
            Self::Undefined(function) => {
                let domain = match function {
                    Function::Sqrt => "an argument that is not negative",
                    Function::Asin | Function::Acos => "an argument between -1 and 1",
                    Function::Ln => "a positive argument",
                    Function::Tan => "an angle other than odd multiples of `90deg`",
                    _ => "an argument in its domain",
                };
                write!(f, "`{}` has no value here: write {domain}", function.name())
            }
            Self::OutOfRange => f.write_str("this constant is beyond the range of `f64`, 2.3e-308 to 1.7e308"),
            Self::ExponentOverflow => {
                write!(f, "this exponent is too large: write one between -{LARGEST_EXPONENT} and {LARGEST_EXPONENT}")
            }
        }
    }
}

impl Fault {
    /// The reason why a node without symbols has no finite value: its function has none there, or it is beyond the range
    /// of `f64`.
    pub(super) fn of(node: &Node) -> Self {
        match node {
            // These overflow nowhere.
            Node::Call(function, _) if super::operation(*function).may_be_undefined() => Self::Undefined(*function),
            _ => Self::OutOfRange,
        }
    }
}

impl NodeId {
    pub(crate) fn index(self) -> usize {
        self.0
    }
}

impl External {
    /// The derivative of this order by the first argument.
    #[must_use]
    pub fn new(function: ExternalId, arguments: usize, order: usize) -> Self {
        let mut by = vec![0; arguments];
        if let Some(first) = by.first_mut() {
            *first = order;
        }
        Self { function, by }
    }

    /// The order of the derivative, if it is with respect to the first argument only.
    #[must_use]
    pub fn order(&self) -> Option<usize> {
        let (first, rest) = self.by.split_first()?;
        rest.iter().all(|&times| times == 0).then_some(*first)
    }

    /// The derivative of this by one of its arguments.
    pub(super) fn derived(&self, argument: usize) -> Self {
        let mut derivative = self.clone();
        derivative.by[argument] += 1;
        derivative
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

/// The value of one node, given those of its symbols and children; `None` if one is missing.
pub(super) fn node_value(
    node: &Node,
    bind: impl Fn(SymbolId) -> Option<f64>,
    external: impl Fn(&External, &[f64]) -> Option<f64>,
    child: impl Fn(NodeId) -> Option<f64>,
) -> Option<f64> {
    match node {
        Node::Constant(value) => Some(value.to_f64()),
        Node::Pi => Some(std::f64::consts::PI),
        Node::Symbol(symbol) => bind(*symbol),
        Node::Sum { constant, terms } => {
            let mut sum = constant.to_f64();
            for (factor, term) in terms {
                sum += factor.to_f64() * child(*term)?;
            }
            Some(sum)
        }
        Node::Product { coefficient, factors } => {
            let mut product = coefficient.to_f64();
            for (base, exponent) in factors {
                product *= child(*base)?.powi(*exponent);
            }
            Some(product)
        }
        Node::Call(function, arguments) => {
            let arguments: Option<Vec<f64>> = arguments.iter().map(|argument| child(*argument)).collect();
            arguments.map(|arguments| (super::operation(*function).value)(&arguments))
        }
        Node::External(function, arguments) => {
            let arguments: Option<Vec<f64>> = arguments.iter().map(|argument| child(*argument)).collect();
            external(function, &arguments?)
        }
    }
}
