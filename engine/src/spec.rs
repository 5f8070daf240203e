//! Tables and scans by name, without data.

use serde::{Deserialize, Serialize};

use crate::Request;

/// The rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TableKind {
    /// A row for each position: `sweep`.
    Sweep,
    /// A row for each case: `cases`.
    Cases,
}

impl TableKind {
    /// The name of the table function.
    #[must_use]
    pub fn function(self) -> &'static str {
        match self {
            Self::Sweep => "sweep",
            Self::Cases => "cases",
        }
    }
}

/// A table: everything that another process needs to compute it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TableSpec {
    /// The rows.
    pub kind: TableKind,
    /// The name that the mechanism is registered under.
    pub mechanism: String,
    /// The plan and its settings.
    pub request: Request,
}

/// A scan of a table: everything that another process needs to compute any of its partitions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScanSpec {
    /// The table.
    pub table: TableSpec,
    /// The indices of the columns in the schema of the table.
    pub projection: Vec<usize>,
    /// The number of rows to compute, the first ones; all without it.
    pub fetch: Option<u64>,
    /// The number of partitions.
    pub partitions: usize,
}
