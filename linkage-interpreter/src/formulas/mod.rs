//! Formulas over numbers of any kind: straight lines of operations on registers, without comparisons and without types.
//!
//! Over intervals a constant that is a double differs from one that is only near a double: it keeps its kind.

mod check;
#[cfg(feature = "compiler")]
mod compile;
mod run;

use linkage_ir::ElementaryFunction;
use serde::{Deserialize, Serialize};

pub(crate) use check::Counts;
#[cfg(feature = "compiler")]
pub(crate) use compile::{Untranslated, formulas};
pub(crate) use run::{Given, Registers};

/// The formulas of a mechanism with `derive intervals`, in the order of emitted code.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Formulas {
    pub residual: Formula<Vec<Register>>,
    /// The columns of J and of A, one after the other.
    pub jacobian_unknowns: Formula<Vec<Register>>,
    pub jacobian_inputs: Formula<Vec<Register>>,
    pub gamma: Formula<Vec<Register>>,
    pub quantities: Formula<Vec<Register>>,
    /// The values with ranges.
    pub ranges: Formula<Vec<Range>>,
    /// The names of the quantities.
    pub names: Vec<String>,
    /// For each group the name of the first user function in its equations.
    pub user_functions: Vec<Option<String>>,
}

/// A straight line of operations, and its results.
///
/// The first registers hold the given numbers: parameters, unknowns, inputs, and the rates of both if the formula has them. Each
/// instruction writes the next ones.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Formula<R> {
    pub instructions: Vec<Instruction>,
    pub results: R,
}

/// A place of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Register(pub u32);

/// A value with a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Range {
    pub value: Register,
    pub least: Option<Register>,
    pub most: Option<Register>,
    /// True for an angle modulo whole turns.
    pub is_direction: bool,
}

/// An operation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Instruction {
    Constant(Constant),
    Unary(Unary, Register),
    Binary(Binary, Register, Register),
    /// An elementary function of one number.
    Of(ElementaryFunction, Register),
    /// One of two numbers.
    OfTwo(ElementaryFunction, Register, Register),
    /// The sine and the cosine, in two registers.
    SineCosine(Register),
}

/// A constant, as the type of the numbers makes it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Constant {
    Zero,
    One,
    Pi,
    /// A value of a user function.
    Unknown,
    /// This double.
    Exactly(f64),
    /// A number of which this is the nearest double.
    Near(f64),
    /// The quotient of two doubles.
    Ratio(f64, f64),
}

/// An operation on one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Unary {
    Negative,
    Square,
}

/// An operation on two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Binary {
    Plus,
    Minus,
    Times,
    Over,
}

impl Instruction {
    /// The number of registers that it writes.
    pub(crate) fn writes(&self) -> u32 {
        if matches!(self, Self::SineCosine(_)) { 2 } else { 1 }
    }

    /// The registers that it reads.
    fn reads(&self) -> impl Iterator<Item = Register> {
        let both = match *self {
            Self::Constant(_) => [None, None],
            Self::Unary(_, of) | Self::Of(_, of) | Self::SineCosine(of) => [Some(of), None],
            Self::Binary(_, one, other) | Self::OfTwo(_, one, other) => [Some(one), Some(other)],
        };
        both.into_iter().flatten()
    }
}
