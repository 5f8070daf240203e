//! The error of sweeps.

use std::fmt;
use std::io;
use std::path::PathBuf;

use linkage_runtime::{InputError, PathError};

/// The reason why a sweep cannot be planned, computed or written.
#[derive(Debug)]
#[non_exhaustive]
pub enum SweepError {
    /// A plan without factors.
    EmptyPlan,
    /// A sample without columns.
    EmptySample,
    /// A count of zero.
    Zero {
        /// The thing that is counted.
        quantity: &'static str,
        /// The column that it belongs to, if any.
        column: Option<String>,
    },
    /// A plan with more rows than a `u64` holds.
    TooManyRows,
    /// A case of more factors than the plan has.
    TooManyFactors {
        /// The factors of a case.
        factors: usize,
        /// The factors of the plan.
        most: usize,
    },
    /// A column that is named twice.
    Twice {
        /// The column.
        column: String,
    },
    /// A column that the mechanism does not have.
    UnknownColumn {
        /// The mechanism.
        mechanism: &'static str,
        /// "given" or "found".
        kind: &'static str,
        /// The name.
        column: String,
        /// The column with the most similar name, if any is similar.
        nearest: Option<&'static str>,
    },
    /// An index of a column that the mechanism does not have.
    UnknownIndex {
        /// The mechanism.
        mechanism: &'static str,
        /// "given" or "found".
        kind: &'static str,
        /// The index.
        index: usize,
        /// The number of such columns.
        count: usize,
    },
    /// An input that the plan does not name.
    MissingInput {
        /// The mechanism.
        mechanism: &'static str,
        /// The input.
        input: &'static str,
    },
    /// A number that is infinite or NaN, or becomes so as a scalar of the mechanism.
    NotFinite {
        /// The column that it belongs to.
        column: String,
        /// The name of the number.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A case with a parameter that varies, which has no single motion.
    SeveralDesigns {
        /// The case.
        case: u64,
    },
    /// A case whose motion cannot be followed from any of its rows.
    NoMotion {
        /// The case.
        case: u64,
        /// Why not from the last of them.
        error: PathError,
    },
    /// A standard deviation less than zero.
    NegativeDeviation {
        /// The column.
        column: String,
        /// Its value.
        value: f64,
    },
    /// A histogram whose lower end is not less than its upper end.
    EmptyRange {
        /// The column.
        column: String,
        /// The lower end.
        from: f64,
        /// The upper end.
        to: f64,
    },
    /// A chunk or row that the sweep does not have.
    OutOfRange {
        /// "chunk" or "row".
        quantity: &'static str,
        /// Its number.
        number: u64,
        /// The number of chunks or rows.
        count: u64,
    },
    /// The memory for columns cannot be allocated.
    Memory {
        /// The number of entries of one column.
        entries: usize,
    },
    /// The columns do not suit the mechanism.
    Columns(InputError),
    /// The threads cannot be started.
    Threads(rayon::ThreadPoolBuildError),
    /// A file cannot be written.
    Io {
        /// The file or folder; none if a writer was given.
        path: Option<PathBuf>,
        /// The attempt that failed.
        attempt: &'static str,
        /// The reason.
        source: io::Error,
    },
    /// The path is that of a folder or a device, which a file cannot replace.
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The callback has cancelled the sweep.
    Cancelled {
        /// The number of rows that were computed and folded or handed over.
        rows_done: u64,
        /// The number of rows of the sweep.
        rows: u64,
    },
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptyPlan => write!(f, "the plan has no factors: add a grid, a turn or a sample"),
            Self::EmptySample => write!(f, "a sample of the plan has no columns"),
            Self::Zero { quantity, column } => {
                let (of, column) = column.as_deref().map_or(("", ""), |column| (" of ", column));
                write!(f, "the number of {quantity}{of}{column} is 0: it must be at least 1")
            }
            Self::TooManyRows => write!(f, "the plan has more than {} rows", u64::MAX),
            Self::TooManyFactors { factors, most } => {
                write!(f, "a case of {factors} factors is more than the plan, which has {most}")
            }
            Self::Twice { column } => write!(f, "the column {column} is named twice"),
            Self::UnknownColumn { mechanism, kind, column, nearest } => {
                write!(f, "{mechanism} has no {kind} column {column}")?;
                nearest.map_or(Ok(()), |nearest| write!(f, ", did you mean {nearest}?"))
            }
            Self::UnknownIndex { mechanism, kind, index, count } => {
                write!(f, "{mechanism} has no {kind} column of index {index}: it has {count}")
            }
            Self::MissingInput { mechanism, input } => {
                write!(f, "the plan does not name {input}, an input of {mechanism}")
            }
            Self::NotFinite { column, quantity, value } => {
                write!(f, "the {quantity} of {column} is {value:?}: it must be a finite number of the scalar type")
            }
            Self::SeveralDesigns { case } => write!(
                f,
                "a parameter varies in case {case}, which has no single motion: the factors of a case vary the input only"
            ),
            Self::NoMotion { case, error } => write!(f, "the motion of case {case} cannot be followed: {error}"),
            Self::NegativeDeviation { column, value } => {
                write!(f, "the standard deviation of {column} is {value:?}: it must be at least 0")
            }
            Self::EmptyRange { column, from, to } => {
                write!(f, "the range of {column} is from {from:?} to {to:?}: the first must be less than the second")
            }
            Self::OutOfRange { quantity, number, count } => {
                write!(f, "the sweep has no {quantity} {number}: it has {count}, counted from 0")
            }
            Self::Memory { entries } => write!(f, "no memory for a column of {entries} entries"),
            Self::Columns(error) => error.fmt(f),
            Self::Threads(error) => write!(f, "cannot start the threads: {error}"),
            Self::Io { path: Some(path), attempt, source } => {
                write!(f, "cannot {attempt} {}: {source}", path.display())
            }
            Self::Io { path: None, attempt, source } => write!(f, "cannot {attempt} the writer: {source}"),
            Self::NotAFile { path } => {
                write!(f, "{} is a folder or a device: a file cannot replace it", path.display())
            }
            Self::Cancelled { rows_done, rows } => write!(f, "cancelled after {rows_done} of {rows} rows"),
        }
    }
}

impl std::error::Error for SweepError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            Self::Threads(error) => Some(error),
            Self::Columns(error) => Some(error),
            Self::NoMotion { error, .. } => Some(error),
            _ => None,
        }
    }
}

impl From<InputError> for SweepError {
    fn from(error: InputError) -> Self {
        Self::Columns(error)
    }
}
