//! A mechanism that a motion borrows or owns.

/// A mechanism, borrowed or owned.
pub(super) enum Held<'a, M> {
    Borrowed(&'a M),
    Owned(M),
}

impl<M> Held<'_, M> {
    pub(super) fn get(&self) -> &M {
        match self {
            Self::Borrowed(mechanism) => mechanism,
            Self::Owned(mechanism) => mechanism,
        }
    }
}
