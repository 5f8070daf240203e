//! Derivations as data: what the compiler finds out about a mechanism, and documents print.
//!
//! Each record is one type in two [`Storage`]s: [`Lent`], whose texts and lists are those of constants in emitted code, without
//! an allocator; and with the feature `code` [`Kept`], which the compiler fills and a file holds. What is kept is lent to
//! readers by a [`Store`], part by part.

#[macro_use]
mod record;

mod chain;
#[cfg(feature = "code")]
mod kept;
mod kinematics;
mod node;
mod scene;
mod sheet;

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::Deref;

pub use chain::{ChainJoint, ChainLink, KinematicChain};
#[cfg(feature = "code")]
pub use kept::{Document, Documents, Kept, Part, Store};
pub use kinematics::{
    Counts, Derivation, Entry, Equation, FormulaMatrix, Group, GroupForm, GroupMethod, Kernel, KernelCheck, KernelCode,
    KernelResult, Quantity, Root, Sensitivity, Symbol,
};
#[cfg(feature = "code")]
pub use node::FormulaNodes;
pub use node::{FormulaId, FormulaNode};
pub use scene::{ContactEffect, Effect, JointForce, SceneDerivation};
pub use sheet::{ChainVector, DriverChoice, PointVectors, SheetDerivation, Turning};

/// A part of a document that can be in a list.
pub trait Item: Clone + Debug + Eq {}

impl<T: Clone + Debug + Eq> Item for T {}

/// The kind of place that has the texts, formulas and lists of documents, for a lifetime.
pub trait Storage<'a>: Copy + Debug + Eq + 'a {
    /// A text.
    type Text: Item + Deref<Target = str> + 'a;
    /// A formula.
    type Formula: Item + Copy + 'a;
    /// A list.
    type List<T: Item + 'a>: Item + Deref<Target = [T]> + 'a;
}

/// The text of a storage.
pub type Text<'a, S> = <S as Storage<'a>>::Text;
/// The formula of a storage.
pub type Formula<'a, S> = <S as Storage<'a>>::Formula;
/// The list of a storage.
pub type List<'a, S, T> = <S as Storage<'a>>::List<T>;

/// Texts and lists that a constant or an arena owns, with formulas that know their table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lent<F>(PhantomData<F>);

impl<'a, F: Item + Copy + 'a> Storage<'a> for Lent<F> {
    type Text = &'a str;
    type Formula = F;
    type List<T: Item + 'a> = &'a [T];
}
