//! Functions of a program, and their code.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::String;
use alloc::vec::Vec;

use super::statement::Statement;
use super::types::Type;
use super::value::{Callee, Value};
use crate::{ExternalId, Operations, Slot, ValueId};

/// A function of a program; `B` is its body, planned or compiled.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Function<B = Code> {
    /// Its name.
    pub name: String,
    /// The lines of its doc comment.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub doc: Vec<String>,
    /// Its callers.
    pub access: Access,
    /// True if it takes `&self`.
    pub is_method: bool,
    /// The other arguments.
    pub arguments: Vec<Argument>,
    /// The type of its value; in a fallible function that of its success.
    pub returns: Type,
    /// True if it returns a `Result`.
    pub is_fallible: bool,
    /// Its body; `None` in a stub.
    pub body: Option<B>,
}

impl<B> Function<B> {
    /// This signature without a body.
    pub fn without_body<C>(self) -> Function<C> {
        let Self { name, doc, access, is_method, arguments, returns, is_fallible, body: _ } = self;
        Function { name, doc, access, is_method, arguments, returns, is_fallible, body: None }
    }

    /// This signature with the body that another function makes of its body.
    ///
    /// # Errors
    /// That of the other function.
    pub fn try_map<C, E>(self, other: impl FnOnce(B) -> Result<C, E>) -> Result<Function<C>, E> {
        let Self { name, doc, access, is_method, arguments, returns, is_fallible, body } = self;
        let body = body.map(other).transpose()?;
        Ok(Function { name, doc, access, is_method, arguments, returns, is_fallible, body })
    }
}

/// The callers of a function, which decide its visibility and attributes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Access {
    /// Users.
    Public,
    /// Public, `#[inline]`: inlined together, the functions on a pose read it from registers, not from memory.
    PublicInlined,
    /// Public, but called mostly by the runtime through traits: `#[doc(hidden)]`.
    Hidden,
    /// Public, `#[deprecated]` with the doc comment as the note.
    Deprecated,
    /// Private, `#[inline]`.
    Inlined,
    /// Private to scenes, `#[inline(always)]`: the optimiser removes results that the caller does not use.
    Layer,
    /// Public, and a [`Layer`](Self::Layer) for scenes.
    PublicLayer,
    /// Private or of a trait, `#[inline(always)]`: called in a loop that the compiler vectorises.
    Lane,
    /// Private, `#[inline]`: called for a lane alone, by the implementation of a trait.
    LaneAlone,
    /// Private, called only after an error: `#[cold]`.
    Cold,
    /// A function of a trait.
    OfTrait,
    /// A function of the trait `Mechanism` that others call: by the path of the trait, so that a function of the user of the
    /// same name is not meant.
    OfMechanism,
}

impl Access {
    /// True if the callers are not functions of the program.
    #[must_use]
    pub fn is_called_from_outside(self) -> bool {
        self.is_public() || matches!(self, Self::Lane | Self::LaneAlone)
    }

    /// True if users can call it.
    #[must_use]
    pub fn is_public(self) -> bool {
        matches!(
            self,
            Self::Public
                | Self::PublicInlined
                | Self::Hidden
                | Self::Deprecated
                | Self::PublicLayer
                | Self::OfMechanism
        )
    }

    /// True if the callers are functions of the program alone.
    #[must_use]
    pub fn is_private(self) -> bool {
        matches!(self, Self::Inlined | Self::Layer | Self::Lane | Self::LaneAlone | Self::Cold)
    }
}

/// An argument of a function.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Argument {
    /// Its name.
    pub name: String,
    /// Its type, and the way it is passed.
    pub passed: Passed,
}

/// The way an argument is passed.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Passed {
    /// `T`
    ByValue(Type),
    /// `&T`
    ByReference(Type),
    /// `&mut T`
    ByMutableReference(Type),
    /// `impl Into<T>`
    Converted(Type),
    /// `&impl Turn<T>`, the source of the turns of angles.
    Turns,
}

/// The compiled body of a function.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Code {
    /// The number of slots.
    pub slots: u32,
    /// Its values.
    pub values: Vec<Value>,
    /// Its statements.
    pub statements: Vec<Statement>,
    /// The value that it returns.
    pub value: Returned,
    /// Names, counts and bounds for those who read it; they are not written with the program.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub readable: Readable,
}

/// Names, counts and bounds of a body for those who read it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readable {
    /// The name of each slot.
    pub slots: Vec<String>,
    /// The functions that it calls.
    pub functions: BTreeMap<Callee, Called>,
    /// The operations of one call.
    pub operations: Operations,
    /// A sentence about the largest rounding errors of its results, if they are known.
    pub accuracy: Option<String>,
    /// The arguments that it uses, by their places.
    pub uses: BTreeSet<usize>,
    /// The user functions that it calls.
    pub externals: BTreeSet<ExternalId>,
}

/// The name of a function that code calls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Called {
    /// The name.
    pub name: String,
    /// True for a function of the trait `Mechanism`.
    pub is_of_mechanism: bool,
}

/// The value that a function returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Returned {
    /// A value; the function wraps it in `Ok` if it is fallible.
    Plain(ValueId),
    /// The `Result` of another function.
    Result(ValueId),
    /// The `Result` in a variable that holds a literal, whose members are stored.
    Stored {
        /// The variable.
        result: ValueId,
        /// The literal with all its members.
        literal: ValueId,
    },
}

impl Returned {
    /// The value that the function returns, for a reader that writes what [`Statement::Store`] says.
    #[must_use]
    pub fn returned(self) -> ValueId {
        match self {
            Self::Plain(value) | Self::Result(value) | Self::Stored { result: value, .. } => value,
        }
    }

    /// The value by its members, for a reader that leaves out each [`Statement::Store`].
    #[must_use]
    pub fn literal(self) -> ValueId {
        match self {
            Self::Plain(value) | Self::Result(value) | Self::Stored { literal: value, .. } => value,
        }
    }
}

impl Code {
    /// The operation that computes a value.
    #[must_use]
    pub fn operation(&self, id: ValueId) -> &Value {
        &self.values[id.index()]
    }

    /// The name of a slot; empty in code that was written and read again, which has no names.
    #[must_use]
    pub fn name(&self, slot: Slot) -> &str {
        self.readable.slots.get(slot.index()).map_or("", String::as_str)
    }

    /// The name of a value that is an argument, or that a statement binds, as [`name`](Self::name) has it.
    #[must_use]
    pub fn name_of(&self, id: ValueId) -> Option<&str> {
        match self.operation(id) {
            Value::Given(slot) => Some(self.name(*slot)),
            _ => None,
        }
    }

    /// The name of a function that it calls; none in code that was written and read again.
    #[must_use]
    pub fn callee(&self, of: Callee) -> Option<&Called> {
        self.readable.functions.get(&of)
    }
}
