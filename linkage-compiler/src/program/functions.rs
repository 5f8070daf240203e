//! The functions of a type, by id.

use super::function::Function;
use crate::ids::{FunctionId, Table};

/// The functions of a driver or of a scene. They are listed in the order of the emitted code.
#[derive(Debug, Clone)]
pub struct Functions<B> {
    all: Table<FunctionId, Function<B>>,
    order: Vec<FunctionId>,
}

impl<B> Functions<B> {
    /// Those with these ids, in this order.
    pub fn listed(all: Table<FunctionId, Function<B>>, order: Vec<FunctionId>) -> Self {
        Self { all, order }
    }

    pub fn iter(&self) -> impl Iterator<Item = &Function<B>> {
        self.order.iter().map(|id| &self.all[*id])
    }

    /// All functions by id, also those that are not listed.
    pub fn by_id(&self) -> &Table<FunctionId, Function<B>> {
        &self.all
    }

    /// The listed function with this name.
    pub fn named(&self, name: &str) -> Option<&Function<B>> {
        self.iter().find(|function| function.name == name)
    }

    /// True if a function with this name is listed.
    pub fn has(&self, name: &str) -> bool {
        self.named(name).is_some()
    }

    pub fn into_table(self) -> Table<FunctionId, Function<B>> {
        self.all
    }
}

impl<B> FromIterator<Function<B>> for Functions<B> {
    fn from_iter<I: IntoIterator<Item = Function<B>>>(functions: I) -> Self {
        let all: Table<FunctionId, Function<B>> = functions.into_iter().collect();
        let order = all.ids().collect();
        Self { all, order }
    }
}

impl<'f, B> IntoIterator for &'f Functions<B> {
    type Item = &'f Function<B>;
    type IntoIter = Box<dyn Iterator<Item = &'f Function<B>> + 'f>;

    fn into_iter(self) -> Self::IntoIter {
        Box::new(self.iter())
    }
}
