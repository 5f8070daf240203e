//! The elementary functions that a node can call.

/// An elementary function of scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sqrt,
    Abs,
    Exp,
    Ln,
    Hypot,
    /// `if_nonzero(a, v, w)`: v, or its limit w where a is zero and v may be 0 / 0. Not in the language.
    IfNonzero,
}
