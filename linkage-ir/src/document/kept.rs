//! Documents that own their texts and lists, and how they are copied to another storage.

use alloc::string::String;
use alloc::vec::Vec;

use super::{
    Derivation, Entry, Equation, FormulaId, FormulaNodes, GroupForm, GroupMethod, Item, KernelCheck, KernelCode,
    SceneDerivation, SheetDerivation, Storage,
};
use crate::Operations;

/// Texts and lists that own their parts, with formulas by their numbers in the nodes of a [`Document`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kept;

impl<'a> Storage<'a> for Kept {
    type Text = String;
    type Formula = FormulaId;
    type List<T: Item + 'a> = Vec<T>;
}

impl Default for KernelCode<'_, Kept> {
    fn default() -> Self {
        Self { steps: Vec::new(), checks: Vec::new(), results: Vec::new() }
    }
}

/// A record and the nodes of its formulas.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Document<D> {
    /// The nodes of its formulas.
    pub nodes: FormulaNodes,
    /// The record.
    pub record: D,
}

/// The documents of a driver as plain data. With the feature `serde` they can be written, and read by a program that compiles
/// nothing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Documents {
    /// The derivation of the driver; none if its mechanism has none.
    pub driver: Option<Document<Derivation<'static, Kept>>>,
    /// The analysis by hand, where formulas for it exist.
    pub by_hand: Option<Document<SheetDerivation<'static, Kept>>>,
    /// The scenes.
    pub scenes: Vec<Document<SceneDerivation<'static, Kept>>>,
    /// The default values of parameters that have one, by name.
    pub defaults: Vec<(String, f64)>,
    /// The doc comment of the mechanism in plain words, paragraph by paragraph.
    pub about: Vec<String>,
}

/// A storage that parts are copied to.
pub trait Store<'a, S: Storage<'a>> {
    /// The mistakes of a document.
    type Error;

    /// Stores a text.
    fn text(&self, text: &str) -> S::Text;
    /// Stores a list.
    fn list<T: Item + 'a>(&self, list: Vec<T>) -> S::List<T>;
    /// The formula with this number.
    ///
    /// # Errors
    /// If there is none.
    fn formula(&self, id: FormulaId) -> Result<S::Formula, Self::Error>;
}

/// A part of a kept document.
pub trait Part {
    /// The part in another storage.
    type In<'a, S: Storage<'a>>: Item + 'a;

    /// Visits all numbers of formulas, in the order of the fields.
    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId));

    /// Copies it to another storage.
    ///
    /// # Errors
    /// As [`Store::formula`].
    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Self::In<'a, S>, T::Error>;
}

impl Part for FormulaId {
    type In<'a, S: Storage<'a>> = S::Formula;

    fn each(&mut self, visit: &mut dyn FnMut(&mut Self)) {
        visit(self);
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<S::Formula, T::Error> {
        store.formula(*self)
    }
}

impl Part for String {
    type In<'a, S: Storage<'a>> = S::Text;

    fn each(&mut self, _: &mut dyn FnMut(&mut FormulaId)) {}

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<S::Text, T::Error> {
        Ok(store.text(self))
    }
}

impl<P: Part> Part for Vec<P> {
    type In<'a, S: Storage<'a>> = S::List<P::In<'a, S>>;

    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
        self.iter_mut().for_each(|part| part.each(visit));
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<S::List<P::In<'a, S>>, T::Error> {
        let parts: Result<Vec<_>, _> = self.iter().map(|part| part.copied(store)).collect();
        Ok(store.list(parts?))
    }
}

impl<P: Part> Part for Option<P> {
    type In<'a, S: Storage<'a>> = Option<P::In<'a, S>>;

    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
        self.iter_mut().for_each(|part| part.each(visit));
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Option<P::In<'a, S>>, T::Error> {
        self.as_ref().map(|part| part.copied(store)).transpose()
    }
}

macro_rules! arrays {
    ($($length:literal: $($part:ident)+;)+) => {$(
        impl<P: Part> Part for [P; $length] {
            type In<'a, S: Storage<'a>> = [P::In<'a, S>; $length];

            fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
                self.iter_mut().for_each(|part| part.each(visit));
            }

            fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Self::In<'a, S>, T::Error> {
                let [$($part),+] = self;
                Ok([$($part.copied(store)?),+])
            }
        }
    )+};
}

arrays! {
    1: one;
    2: one two;
    3: one two three;
    4: one two three four;
}

macro_rules! without_formulas {
    ($($Type:ident)+) => {$(
        impl Part for $Type {
            type In<'a, S: Storage<'a>> = Self;

            fn each(&mut self, _: &mut dyn FnMut(&mut FormulaId)) {}

            fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, _: &T) -> Result<Self, T::Error> {
                Ok(*self)
            }
        }
    )+};
}

without_formulas!(usize GroupForm GroupMethod Operations);

impl<P: Part> Part for Equation<P> {
    type In<'a, S: Storage<'a>> = Equation<P::In<'a, S>>;

    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
        self.left.each(visit);
        self.right.each(visit);
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Self::In<'a, S>, T::Error> {
        Ok(Equation { left: self.left.copied(store)?, right: self.right.copied(store)? })
    }
}

impl<P: Part> Part for Entry<P> {
    type In<'a, S: Storage<'a>> = Entry<P::In<'a, S>>;

    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
        self.value.each(visit);
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Self::In<'a, S>, T::Error> {
        Ok(Entry { row: self.row, column: self.column, value: self.value.copied(store)? })
    }
}

impl<P: Part> Part for KernelCheck<P> {
    type In<'a, S: Storage<'a>> = KernelCheck<P::In<'a, S>>;

    fn each(&mut self, visit: &mut dyn FnMut(&mut FormulaId)) {
        match self {
            Self::Nonzero(of) | Self::Positive(of) | Self::Moderate(of) => of.each(visit),
            Self::Regular(of) | Self::Apart(of) => of.each(visit),
            Self::Open(of) => of.each(visit),
        }
    }

    fn copied<'a, S: Storage<'a>, T: Store<'a, S>>(&self, store: &T) -> Result<Self::In<'a, S>, T::Error> {
        Ok(match self {
            Self::Regular(of) => KernelCheck::Regular(of.copied(store)?),
            Self::Nonzero(of) => KernelCheck::Nonzero(of.copied(store)?),
            Self::Positive(of) => KernelCheck::Positive(of.copied(store)?),
            Self::Apart(of) => KernelCheck::Apart(of.copied(store)?),
            Self::Moderate(of) => KernelCheck::Moderate(of.copied(store)?),
            Self::Open(of) => KernelCheck::Open(of.copied(store)?),
        })
    }
}
