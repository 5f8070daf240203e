//! Typed indices: an id of one space indexes only the tables of that space, so that mixing them is a compile error.
//!
//! ```
//! # use linkage_compiler::ids::{RowId, Table};
//! fn residual(rows: &Table<RowId, f64>, row: RowId) -> f64 { rows[row] }
//! ```
//!
//! ```compile_fail
//! # use linkage_compiler::ids::{RowId, Table, UnknownId};
//! fn residual(rows: &Table<RowId, f64>, unknown: UnknownId) -> f64 { rows[unknown] }
//! ```
//!
//! ```compile_fail
//! # use linkage_compiler::ids::{RowId, Table};
//! fn residual(rows: &Table<RowId, f64>, place: usize) -> f64 { rows[place] }
//! ```

use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};

pub use linkage_ir::{ExternalId, FunctionId, ValueId};

/// An index into the tables of one space.
pub trait Id: Copy {
    fn new(index: usize) -> Self;

    fn index(self) -> usize;

    /// The index counted from one, as in names and doc comments.
    fn number(self) -> usize {
        self.index() + 1
    }
}

macro_rules! ids {
    ($($(#[$doc:meta])* $id:ident)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $id(usize);

        impl Id for $id {
            fn new(index: usize) -> Self {
                Self(index)
            }

            fn index(self) -> usize {
                self.0
            }
        }
    )*};
}

ids! {
    /// A coordinate in the order of declaration.
    CoordinateId
    /// The index of a coordinate in q: a column of Psi_q.
    ColumnId
    /// The index of a dependent coordinate in u: a column of J.
    UnknownId
    /// The index of an independent coordinate in v: a column of A.
    InputId
    /// A row of Psi: a scalar equation, or one of the two of a `loop`.
    RowId
    /// A group of unknowns that are solved together, in the order of solution.
    GroupId
    /// The index of an equation or unknown within a group.
    MemberId
    /// An unordered pair of inputs, for second derivatives.
    PairId
    /// A choice of inputs.
    DriverId
    BodyId
    /// A scene of a mechanism, of any driver.
    SceneId
    /// A parameter of a mechanism.
    ParameterId
    /// A parameter that only scenes use.
    SceneParameterId
}

macro_rules! of_code {
    ($($id:ident)*) => {$(
        impl Id for $id {
            fn new(index: usize) -> Self {
                Self::new(index)
            }

            fn index(self) -> usize {
                self.index()
            }
        }
    )*};
}

of_code! { ExternalId FunctionId ValueId }

/// A list that is indexed by the ids of one space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table<I, T> {
    entries: Vec<T>,
    space: PhantomData<I>,
}

impl<I: Id, T> Table<I, T> {
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + use<I, T> {
        (0..self.entries.len()).map(I::new)
    }

    pub fn enumerated(&self) -> impl Iterator<Item = (I, &T)> {
        self.ids().zip(&self.entries)
    }

    /// Adds an entry and returns its id.
    pub fn push(&mut self, entry: T) -> I {
        self.entries.push(entry);
        I::new(self.entries.len() - 1)
    }

    /// A table of the same length with copies of one entry.
    pub fn filled<U: Clone>(&self, entry: U) -> Table<I, U> {
        vec![entry; self.entries.len()].into()
    }

    /// The entries with these ids.
    pub fn at(&self, ids: &[I]) -> Vec<T>
    where
        T: Copy,
    {
        ids.iter().map(|&id| self[id]).collect()
    }

    /// Applies a function to each entry.
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Table<I, U> {
        self.entries.into_iter().map(f).collect()
    }
}

impl<I, T> Default for Table<I, T> {
    fn default() -> Self {
        Vec::new().into()
    }
}

impl<I, T> From<Vec<T>> for Table<I, T> {
    fn from(entries: Vec<T>) -> Self {
        Self { entries, space: PhantomData }
    }
}

impl<I, T> FromIterator<T> for Table<I, T> {
    fn from_iter<E: IntoIterator<Item = T>>(entries: E) -> Self {
        entries.into_iter().collect::<Vec<T>>().into()
    }
}

impl<I, T> Extend<T> for Table<I, T> {
    fn extend<E: IntoIterator<Item = T>>(&mut self, entries: E) {
        self.entries.extend(entries);
    }
}

impl<I, T> IntoIterator for Table<I, T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.entries.into_iter()
    }
}

impl<'t, I, T> IntoIterator for &'t Table<I, T> {
    type Item = &'t T;
    type IntoIter = std::slice::Iter<'t, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.entries.iter()
    }
}

impl<I: Id, T> Index<I> for Table<I, T> {
    type Output = T;

    fn index(&self, id: I) -> &T {
        &self.entries[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for Table<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.entries[id.index()]
    }
}

/// Gives the methods of slices; indexing needs an id.
impl<I, T> Deref for Table<I, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.entries
    }
}

impl<I, T> DerefMut for Table<I, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }
}
