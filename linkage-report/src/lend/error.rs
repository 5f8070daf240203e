//! The mistakes of a document.

use std::fmt;

/// A document refers to what it does not have. Those that the compiler makes are sound.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unsound {
    /// A node of the table does not refer to nodes before it, or to a name where a derivative needs one.
    Table,
    /// The table has no node with this number.
    Formula(u32),
    /// A list has no item at this place, counted from 0.
    Place {
        /// The name of the list.
        list: &'static str,
        /// The place.
        place: usize,
    },
}

impl fmt::Display for Unsound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table => f.write_str("a formula of the document refers to one that is not before it"),
            Self::Formula(number) => write!(f, "the document has no formula {number}"),
            Self::Place { list, place } => write!(f, "the document has no item {place} in its list of {list}"),
        }
    }
}

impl std::error::Error for Unsound {}

/// An error if a list of this length has not all of these places.
pub(super) fn places(list: &'static str, places: &[usize], length: usize) -> Result<(), Unsound> {
    let outside = places.iter().copied().find(|place| *place >= length);
    outside.map_or(Ok(()), |place| Err(Unsound::Place { list, place }))
}
