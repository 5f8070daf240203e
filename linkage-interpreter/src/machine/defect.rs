//! Code that has no meaning.

use std::fmt::{self, Display, Formatter};

/// Code that has no meaning: it is damaged, or there is a mistake in this library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Defect(String);

impl Defect {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self(what.into())
    }
}

impl Display for Defect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "the compiled code has no meaning: {}", self.0)
    }
}

impl std::error::Error for Defect {}
