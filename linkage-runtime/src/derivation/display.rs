//! A formula as text.

use super::notation::{Unicode, write};
use super::table::Formula;
use core::fmt;

impl fmt::Display for Formula<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(&Unicode, *self, f)
    }
}

/// The text in quotes.
impl fmt::Debug for Formula<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{self}\"")
    }
}

/// Its text.
#[cfg(feature = "serde")]
impl serde::Serialize for Formula<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
