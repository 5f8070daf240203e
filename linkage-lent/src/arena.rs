//! The owner of texts and lists.

use bumpalo::Bump;

use crate::error::Unsound;

/// Texts and lists that are freed together.
#[derive(Debug, Default)]
pub(crate) struct Arena {
    bump: Bump,
}

impl Arena {
    pub(crate) fn text(&self, text: &str) -> &str {
        self.bump.alloc_str(text)
    }

    pub(crate) fn texts(&self, all: &[String]) -> &[&str] {
        self.bump.alloc_slice_fill_iter(all.iter().map(|text| self.text(text)))
    }

    pub(crate) fn one<T: Copy>(&self, one: T) -> &T {
        self.bump.alloc(one)
    }

    pub(crate) fn copied<T: Copy>(&self, all: &[T]) -> &[T] {
        self.bump.alloc_slice_copy(all)
    }

    /// The converted items of a list, or the first mistake.
    pub(crate) fn list<A, B>(&self, all: &[A], convert: impl FnMut(&A) -> Result<B, Unsound>) -> Result<&[B], Unsound>
    where
        B: Copy,
    {
        Ok(self.bump.alloc_slice_try_fill_iter(all.iter().map(convert))?)
    }
}
