//! The error of record batches and files.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use arrow_schema::ArrowError;
use linkage_sweep::SweepError;
use parquet::errors::ParquetError;

/// The reason why a sweep does not become record batches or a file.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The sweep cannot be computed, or was cancelled.
    Sweep(SweepError),
    /// A schema of other columns than those of the chunk.
    Schema {
        /// The index of the column.
        index: usize,
        /// The column of the chunk.
        column: &'static str,
    },
    /// Arrow returned an error.
    Arrow(ArrowError),
    /// The writer of Parquet returned an error.
    Parquet(ParquetError),
    /// A file cannot be written.
    Io {
        /// The file or folder; none if a writer was given.
        path: Option<PathBuf>,
        /// The attempt that failed.
        attempt: &'static str,
        /// The reason.
        source: io::Error,
    },
}

impl Error {
    /// The error with the path of the file, if it is one of input or output without a path.
    pub(crate) fn at(self, path: &Path) -> Self {
        match self {
            Self::Io { path: None, attempt, source } => Self::Io { path: Some(path.to_owned()), attempt, source },
            error => error,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sweep(error) => error.fmt(f),
            Self::Schema { index, column } => {
                write!(f, "the schema does not have the column {column} at index {index}")
            }
            Self::Arrow(error) => write!(f, "Arrow: {error}"),
            Self::Parquet(error) => write!(f, "Parquet: {error}"),
            Self::Io { path: Some(path), attempt, source } => {
                write!(f, "cannot {attempt} {}: {source}", path.display())
            }
            Self::Io { path: None, attempt, source } => write!(f, "cannot {attempt} the writer: {source}"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Sweep(error) => std::error::Error::source(error),
            Self::Schema { .. } => None,
            Self::Arrow(error) => Some(error),
            Self::Parquet(error) => Some(error),
            Self::Io { source, .. } => Some(source),
        }
    }
}

impl From<SweepError> for Error {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Io { path, attempt, source } => Self::Io { path, attempt, source },
            error => Self::Sweep(error),
        }
    }
}

impl From<ArrowError> for Error {
    fn from(error: ArrowError) -> Self {
        match error {
            ArrowError::IoError(_, source) => Self::from(source),
            error => Self::Arrow(error),
        }
    }
}

impl From<ParquetError> for Error {
    fn from(error: ParquetError) -> Self {
        match error {
            ParquetError::External(inner) => match inner.downcast::<io::Error>() {
                Ok(source) => Self::from(*source),
                Err(inner) => match inner.downcast::<ArrowError>() {
                    Ok(error) => Self::from(*error),
                    Err(inner) => Self::Parquet(ParquetError::External(inner)),
                },
            },
            error => Self::Parquet(error),
        }
    }
}

impl From<io::Error> for Error {
    fn from(source: io::Error) -> Self {
        Self::Io { path: None, attempt: "write", source }
    }
}
