//! Values: the operations of compiled code.

use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;

use super::statement::{Block, Pattern};
use super::types::Type;
use crate::{Constant, ElementaryFunction, ExternalId, FunctionId, Intrinsic, Name, Number, Slot, ValueId};

impl Slot {
    /// That of `self`.
    pub const ITSELF: Self = Self::new(0);

    /// That of an argument, by its place among the arguments.
    #[must_use]
    pub const fn of_argument(place: usize) -> Self {
        Self::new(place + 1)
    }
}

/// A value or its negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Signed {
    /// True for the negative.
    pub negative: bool,
    /// The value.
    pub value: ValueId,
}

/// The value or type that a function of the program is called on.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Receiver<E> {
    /// `self.f()`
    Itself,
    /// `Self::f()`
    ItsType,
    /// `value.f()`, a function of the driver.
    Value(E),
    /// `Type::f()`, a function of the driver.
    Type(Box<Type>),
}

/// A function that the program defines or takes from the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Callee {
    /// One of the same type.
    Own(FunctionId),
    /// One of the driver of a scene.
    OfDriver(FunctionId),
    /// A function of the user.
    User(ExternalId),
}

impl<E> Receiver<E> {
    /// The function with this id that is called on it.
    pub fn callee(&self, function: FunctionId) -> Callee {
        match self {
            Self::Itself | Self::ItsType => Callee::Own(function),
            Self::Value(_) | Self::Type(_) => Callee::OfDriver(function),
        }
    }
}

/// The operation that computes a value, six words long: what is longer is boxed. `G` is what is given without an operation, `V`
/// what patterns bind: slots in compiled code, what the compiler knows of them while it orders the code.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Value<G = Slot, V = Slot> {
    /// An argument, or what a statement binds.
    Given(G),

    // Arithmetic.
    /// A constant of a scalar.
    Constant(Number),
    /// This constant, written as a multiple of pi: pi times a count, divided by a number of parts.
    Turn(Number, i32, u32),
    /// A constant of formulas over numbers of any kind, such as intervals: a double is not close enough to a ratio.
    Exact(Number),
    /// The sum of these.
    Sum(Vec<Signed>),
    /// The product of these.
    Product(Vec<ValueId>),
    /// The first divided by the second.
    Quotient(ValueId, ValueId),
    /// The product of a value with itself.
    Square(ValueId),
    /// The negative of a value. That of a product is written before its first factor.
    Negative(ValueId),
    /// An elementary function of these values or their negatives.
    Call(ElementaryFunction, Vec<Signed>),
    /// All conditions, none of them left out.
    All(Vec<ValueId>),

    // Data.
    /// A text.
    Text(Arc<str>),
    /// A count.
    Count(usize),
    /// A constant of the runtime, or of the type.
    Path(Constant),
    /// A field by its name.
    Field(ValueId, Name),
    /// A field of a tuple by its place.
    Member(ValueId, usize),
    /// The columns of a matrix as lists, `matrix.data.0`.
    Columns(ValueId),
    /// The entry of a list at a place that is known.
    Index(ValueId, usize),
    /// The entry of a list at a number that is known when the function runs.
    At(ValueId, ValueId),
    /// A list of known length.
    List(Vec<ValueId>),
    /// `[value; count]`
    Repeated(ValueId, usize),
    /// Values of several types.
    Tuple(Vec<ValueId>),
    /// `Type { field: value, ..rest }`
    Struct(Box<Type>, Vec<(Name, ValueId)>, Option<ValueId>),

    // Calls.
    /// A function that the program does not define; an associated one belongs to a type.
    Intrinsic(Intrinsic, Option<Box<Type>>, Vec<ValueId>),
    /// Such a function as a value.
    Function(Intrinsic, Option<Box<Type>>),
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
        /// The patterns that take the arguments.
        arguments: Vec<Pattern<V>>,
        /// The body.
        body: Box<Block<V>>,
        /// True if it takes what it reads.
        moves: bool,
    },
    /// `{ … }`
    Block(Box<Block<V>>),
}

/// A value that is given without an operation. While the compiler orders the code it may have operands.
pub trait Given {
    /// Visits the operands.
    fn each_part(&self, visit: &mut dyn FnMut(ValueId));

    /// Replaces the operands.
    fn change_parts(&mut self, change: &mut dyn FnMut(&mut ValueId));
}

impl Given for Slot {
    fn each_part(&self, _visit: &mut dyn FnMut(ValueId)) {}

    fn change_parts(&mut self, _change: &mut dyn FnMut(&mut ValueId)) {}
}

impl<G: Given, V> Value<G, V> {
    /// Visits the operands, without what is inside of inner functions and blocks.
    pub fn each_part(&self, mut visit: impl FnMut(ValueId)) {
        match self {
            Self::Given(given) => given.each_part(&mut visit),
            Self::Constant(_)
            | Self::Turn(..)
            | Self::Exact(_)
            | Self::Text(_)
            | Self::Count(_)
            | Self::Path(_)
            | Self::Function(..)
            | Self::Closure { .. }
            | Self::Block(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) => parts.iter().for_each(|part| visit(part.value)),
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
            | Self::Member(of, _)
            | Self::Columns(of)
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

    /// Replaces the operands that are not in statements of inner functions and blocks.
    pub fn change_parts(&mut self, change: &mut dyn FnMut(&mut ValueId)) {
        match self {
            Self::Given(given) => given.change_parts(change),
            Self::Constant(_)
            | Self::Turn(..)
            | Self::Exact(_)
            | Self::Text(_)
            | Self::Count(_)
            | Self::Path(_)
            | Self::Function(..)
            | Self::Closure { .. }
            | Self::Block(_) => {}
            Self::Sum(parts) | Self::Call(_, parts) => parts.iter_mut().for_each(|part| change(&mut part.value)),
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
            | Self::Member(of, _)
            | Self::Columns(of)
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
    }

    /// True if it is arithmetic of a scalar: a number by numbers.
    pub fn is_arithmetic(&self) -> bool {
        matches!(
            self,
            Self::Constant(_)
                | Self::Turn(..)
                | Self::Sum(_)
                | Self::Product(_)
                | Self::Quotient(..)
                | Self::Square(_)
                | Self::Negative(_)
                | Self::Call(..)
        )
    }
}

impl Signed {
    /// The value itself.
    #[must_use]
    pub fn positive(value: ValueId) -> Self {
        Self { negative: false, value }
    }
}
