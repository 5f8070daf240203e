//! Compiled functions: what the compiler lowered, with names and types resolved, so that it is written, read and run
//! without the compiler.
//!
//! An expression refers to others of its function by their index, always to earlier ones: there are no cycles. A value
//! that a statement binds has a slot, any other is computed where it is used, in the order in which emitted code computes it.

mod names;

use std::sync::Arc;

use linkage_ir::{self as ir, ElementaryFunction, Intrinsic};
use serde::{Deserialize, Serialize};

pub(crate) use names::Names;

/// The index of an expression of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(crate) struct Id(pub u32);

/// The slot of a bound value in a call: `self`, the arguments, then what statements bind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(crate) struct Slot(pub u32);

/// The number of a name in [`Names`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(crate) struct Name(pub u32);

/// A function.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Function {
    pub name: String,
    pub access: Access,
    pub is_method: bool,
    pub is_fallible: bool,
    pub arguments: Vec<Argument>,
    pub returns: Shape,
    /// The number of slots.
    pub slots: u32,
    pub expressions: Vec<Expression>,
    pub statements: Vec<Statement>,
    pub value: Returned,
}

/// The callers of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Access {
    Public,
    /// Called by functions of the program alone.
    Private,
    /// The runtime, by a trait of its own.
    OfTrait,
}

/// An argument.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Argument {
    pub name: String,
    pub shape: Shape,
}

/// The form of a value: its numbers by name and by place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    Number,
    Flag,
    Count,
    Text,
    /// A value with fields: one of the mechanism's types.
    Record(Record),
    /// One quantity for each of the points or outputs.
    Each(Vec<String>, Box<Shape>),
    /// x and y.
    Point,
    Vector(usize),
    /// Rows and columns; its value is the list of its columns.
    Matrix(usize, usize),
    List(Box<Shape>, usize),
    /// Any number of them.
    Many(Box<Shape>),
    Tuple(Vec<Shape>),
    Perhaps(Box<Shape>),
    /// A value of the runtime.
    Other(String),
}

/// The types of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Record {
    Mechanism,
    Scene,
    Inputs,
    Pose,
    Branch,
    Coordinates,
    Rates,
    Accelerations,
    Jerks,
    Motion,
    Kinematics,
    FullKinematics,
}

/// The operation that computes a value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Expression {
    Slot(Slot),
    Number(Constant),
    /// The terms, each with true if it is subtracted.
    Sum(Vec<(bool, Id)>),
    Product(Vec<Id>),
    Quotient(Id, Id),
    Square(Id),
    Negative(Id),
    Call(ElementaryFunction, Vec<Id>),
    /// All conditions, none of them left out.
    All(Vec<Id>),

    Flag(bool),
    /// The constant argument that is true if angles, points and outputs are wanted.
    Quantities,
    Text(Arc<str>),
    /// The name of the mechanism or scene in errors.
    OwnName,
    Count(usize),
    Absent,
    Field(Id, Name),
    Index(Id, usize),
    At(Id, Id),
    /// A list or a tuple.
    List(Vec<Id>),
    Repeated(Id, usize),
    /// A value of this type: fields by name, with the others from another value.
    Record(Name, Vec<(Name, Id)>, Option<Id>),

    /// A function of the runtime, of a scalar or of an emitted type.
    Intrinsic(Intrinsic, Vec<Id>),
    /// A constant of the runtime.
    OfRuntime(ir::Constant),
    /// A value of another form from one with the same numbers.
    Made(Made, Id),
    /// A function of the same type, called on `self`.
    Own(usize, Vec<Id>),
    /// A function of the mechanism, called on a value or on nothing.
    OfMechanism(Option<Id>, usize, Vec<Id>),
    /// A function of the pose or the branch.
    OfType(Type, usize, Vec<Id>),
    /// A function of the user by its place, which returns its value and its derivatives.
    User(usize, Vec<Id>),
    Try(Id),
    Closure(Vec<Pattern>, Block),
    Block(Block),
}

impl Expression {
    /// True if it computes a number.
    pub(crate) fn is_arithmetic(&self) -> bool {
        matches!(
            self,
            Self::Number(_)
                | Self::Sum(_)
                | Self::Product(_)
                | Self::Quotient(..)
                | Self::Square(_)
                | Self::Negative(_)
                | Self::Call(..)
        )
    }
}

/// The form of a value that is made from another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Made {
    /// The list of a column, of the columns of a matrix, or of the fields of a record.
    List,
    Matrix,
    /// The inputs of coordinates by name.
    Inputs,
    /// A mechanism from the list of its parameters.
    Mechanism,
}

/// The types besides mechanism and scene that have functions of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Type {
    Pose,
    Branch,
}

/// A constant of formulas: a number of any scalar.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Constant {
    /// A double.
    Double(f64),
    /// pi times the first number, divided by the second; a factor of 1 is left out.
    Turn(f64, f64),
}

/// A statement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Statement {
    Let(Pattern, Id),
    Do(Id),
    /// Replaces a part of a bound value.
    Assign(Place, Id),
    Return(Id),
    /// Binds, or returns the second value if the pattern does not match the first.
    LetElse(Pattern, Id, Id),
    /// Runs the statements unless all conditions are true.
    Unless(Vec<Id>, Vec<Statement>),
}

/// A part of a bound value: its entry at each of these indices, of lists within lists.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    pub of: Slot,
    pub at: Vec<Id>,
}

/// Statements and a value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Block {
    pub statements: Vec<Statement>,
    pub value: Id,
}

/// A pattern that binds values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum Pattern {
    Bound(Slot),
    Ignored,
    /// `Some(pattern)` or `Ok(pattern)`
    Present(Box<Pattern>),
    List(Vec<Pattern>),
    Record(Vec<(Name, Pattern)>),
}

/// The value that a function returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Returned {
    /// A value; in a fallible function it is a success.
    Plain(Id),
    /// The outcome of another function.
    Outcome(Id),
}
