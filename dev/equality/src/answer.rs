//! The answers, and the reasons why there is none.

use std::fmt;

use linkage_compiler::graph::Number;

/// The limit of work, in products of terms, so that every comparison ends soon.
pub const MOST_TERMS: usize = 200_000;

/// The highest order of roots of unity: a quarter of a degree.
pub const HIGHEST_ORDER: u32 = 1440;

/// The result of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// Equal wherever both are defined.
    Equal,
    /// Different somewhere, indeed almost everywhere.
    Different,
    /// Not known.
    Undecided(Reason),
}

/// The reason why equality was not decided.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The difference contains a function that is not rational in sines and cosines.
    OutsideClass(&'static str),
    /// The difference contains this user function.
    External(String),
    /// The difference contains the sine or cosine of a quotient of sums.
    AngleIsQuotient,
    /// The difference contains a number that is no exact ratio.
    Inexact(Number),
    /// A denominator is identically zero.
    Undefined,
    /// The difference is zero only if constants such as pi and sin(1) have an unknown relation.
    Constants,
    /// A number is beyond the range of exact ratios, or an angle is too small a part of a turn.
    TooLarge,
    /// More than [`MOST_TERMS`] products of terms.
    TooManyTerms,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot decide: ")?;
        match self {
            Self::OutsideClass(name) => write!(f, "`{name}` is not rational in sines and cosines"),
            Self::External(name) => write!(f, "the properties of the function `{name}` are not known"),
            Self::AngleIsQuotient => write!(f, "an angle is a quotient of sums"),
            Self::Inexact(value) => write!(f, "the number {value} is not exact"),
            Self::Undefined => write!(f, "a denominator is identically zero"),
            Self::Constants => write!(f, "constants such as pi and sin(1) may be related"),
            Self::TooLarge => write!(f, "the numbers are too large"),
            Self::TooManyTerms => write!(f, "more than {MOST_TERMS} products of terms"),
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Equal => write!(f, "equal"),
            Self::Different => write!(f, "different"),
            Self::Undecided(reason) => reason.fmt(f),
        }
    }
}

/// The reason why a computation ends early.
#[derive(Debug)]
pub(crate) enum Halt {
    Undecided(Reason),
    /// Roots of unity of this order are needed.
    Order(u32),
}

impl From<Reason> for Halt {
    fn from(reason: Reason) -> Self {
        Self::Undecided(reason)
    }
}

/// A computation that may end early.
pub(crate) type Outcome<T> = Result<T, Halt>;
