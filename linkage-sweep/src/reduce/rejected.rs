//! The reasons of rejected rows.

use std::fmt;

use linkage_runtime::PositionError;
use linkage_runtime::lanes::Lanes;

use super::Reducer;
use crate::{Block, Column, SweepError};

/// Counts the rejected rows by the kind of their error: those without a position, rates and accelerations. Points and
/// outputs that do not exist reject no row.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rejected;

/// The rejected rows of a sweep.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Rejections {
    /// The kinds that occur, each once, in the order of [`Kind`].
    pub kinds: Vec<RejectedKind>,
}

/// The rejected rows of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RejectedKind {
    /// The kind.
    pub kind: Kind,
    /// The number of rows.
    pub count: u64,
    /// The first of them.
    pub first_row: u64,
    /// The error of that row; none if it is accepted alone.
    pub error: Option<PositionError>,
}

/// The variants of [`PositionError`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Kind {
    /// [`PositionError::Singular`].
    Singular,
    /// [`PositionError::Unbuildable`].
    Unbuildable,
    /// [`PositionError::Undetermined`].
    Undetermined,
    /// [`PositionError::NotConverged`].
    NotConverged,
    /// [`PositionError::OtherBranch`].
    OtherBranch,
    /// [`PositionError::NotFinite`].
    NotFinite,
    /// [`PositionError::Input`].
    Input,
    /// Another error.
    Other,
}

impl From<PositionError> for Kind {
    fn from(error: PositionError) -> Self {
        match error {
            PositionError::Singular { .. } => Self::Singular,
            PositionError::Unbuildable { .. } => Self::Unbuildable,
            PositionError::Undetermined { .. } => Self::Undetermined,
            PositionError::NotConverged { .. } => Self::NotConverged,
            PositionError::OtherBranch { .. } => Self::OtherBranch,
            PositionError::NotFinite { .. } => Self::NotFinite,
            PositionError::Input(_) => Self::Input,
            _ => Self::Other,
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Singular => "singular",
            Self::Unbuildable => "cannot be assembled",
            Self::Undetermined => "undetermined",
            Self::NotConverged => "not converged",
            Self::OtherBranch => "other branch",
            Self::NotFinite => "not finite",
            Self::Input => "invalid input",
            Self::Other => "other error",
        })
    }
}

impl Rejections {
    /// The number of rejected rows.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.kinds.iter().map(|kind| kind.count).sum()
    }

    /// The number of rejected rows of a kind.
    #[must_use]
    pub fn count(&self, kind: Kind) -> u64 {
        self.kinds.iter().find(|entry| entry.kind == kind).map_or(0, |entry| entry.count)
    }

    fn add(&mut self, other: RejectedKind) {
        match self.kinds.binary_search_by_key(&other.kind, |entry| entry.kind) {
            Err(place) => self.kinds.insert(place, other),
            Ok(place) => {
                let entry = &mut self.kinds[place];
                let count = entry.count + other.count;
                if other.first_row < entry.first_row {
                    *entry = other;
                }
                entry.count = count;
            }
        }
    }
}

impl<M: Lanes> Reducer<M> for Rejected {
    type Part = Rejections;
    type Output = Rejections;

    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    fn start(&self) -> Result<Self::Part, SweepError> {
        Ok(Rejections::default())
    }

    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>) {
        for (first_row, error) in block.rejected() {
            part.add(RejectedKind { kind: error.map_or(Kind::Other, Kind::from), count: 1, first_row, error });
        }
    }

    fn merge(&self, part: &mut Self::Part, other: Self::Part) {
        other.kinds.into_iter().for_each(|kind| part.add(kind));
    }

    fn finish(&self, part: Self::Part) -> Self::Output {
        part
    }
}
