//! The functions of a type, by id.

use super::function::Function;
use crate::ids::{FunctionId, Table};

/// The functions of a driver or of a scene; those of a lowered program are in the order of the emitted code.
#[derive(Debug, Clone)]
pub struct Functions<B>(Table<FunctionId, Function<B>>);

impl<B> Functions<B> {
    pub fn iter(&self) -> impl Iterator<Item = &Function<B>> {
        self.0.iter()
    }

    /// The functions by id.
    pub fn by_id(&self) -> &Table<FunctionId, Function<B>> {
        &self.0
    }

    /// The function with this name.
    pub fn named(&self, name: &str) -> Option<&Function<B>> {
        self.iter().find(|function| function.name == name)
    }

    /// True if there is a function with this name.
    pub fn has(&self, name: &str) -> bool {
        self.named(name).is_some()
    }

    pub fn into_table(self) -> Table<FunctionId, Function<B>> {
        self.0
    }
}

impl<B> FromIterator<Function<B>> for Functions<B> {
    fn from_iter<I: IntoIterator<Item = Function<B>>>(functions: I) -> Self {
        Self(functions.into_iter().collect())
    }
}

impl<'f, B> IntoIterator for &'f Functions<B> {
    type Item = &'f Function<B>;
    type IntoIter = std::slice::Iter<'f, Function<B>>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
