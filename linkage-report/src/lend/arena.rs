//! The owner of texts and lists.

use bumpalo::Bump;

/// Texts and lists that are freed together.
#[derive(Debug, Default)]
pub(super) struct Arena {
    bump: Bump,
}

impl Arena {
    pub(super) fn text(&self, text: &str) -> &str {
        self.bump.alloc_str(text)
    }

    pub(super) fn one<T>(&self, one: T) -> &T {
        self.bump.alloc(one)
    }

    pub(super) fn list<T>(&self, list: Vec<T>) -> &[T] {
        self.bump.alloc_slice_fill_iter(list)
    }
}
