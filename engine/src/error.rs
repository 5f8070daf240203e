//! The error of tables and queries.

use std::fmt;
use std::io;

use datafusion::arrow::error::ArrowError;
use datafusion::common::SchemaError;
use datafusion::error::DataFusionError;
use linkage_sweep::SweepError;

use crate::nearest::nearest;

/// The reason why a query is not answered.
#[derive(Debug)]
#[non_exhaustive]
pub enum EngineError {
    /// A mechanism that is not registered.
    UnknownMechanism {
        /// The name.
        name: String,
        /// The registered mechanism with the most similar name, if any is similar.
        nearest: Option<String>,
        /// All registered mechanisms.
        known: Vec<String>,
    },
    /// A branch that the mechanism is not registered with.
    UnknownBranch {
        /// The mechanism.
        mechanism: String,
        /// The name.
        name: String,
        /// All its branches with a name.
        known: Vec<String>,
    },
    /// A name that is registered twice.
    Registered {
        /// The thing that is named: "mechanism", "branch" or "column".
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A table function with a wrong number of arguments.
    ArgumentCount {
        /// The table function.
        function: &'static str,
        /// The number of arguments.
        count: usize,
    },
    /// An argument of a table function that is not a string.
    Argument {
        /// The table function.
        function: &'static str,
        /// The argument, counted from 1.
        number: usize,
        /// The meaning of the argument.
        meaning: &'static str,
        /// The argument.
        got: String,
    },
    /// A request that is not the JSON of one. The message has the line and column.
    Request(serde_json::Error),
    /// A table that cannot be opened.
    Table {
        /// The table function.
        function: &'static str,
        /// The mechanism.
        mechanism: String,
        /// The reason.
        source: Box<EngineError>,
    },
    /// A chunk that cannot be computed.
    Chunk {
        /// The mechanism.
        mechanism: String,
        /// The number of the chunk.
        number: u64,
        /// The reason.
        source: Box<EngineError>,
    },
    /// A function of the user panicked.
    Panic(String),
    /// A part of a query that DataFusion would ignore.
    Unsupported {
        /// The part.
        part: &'static str,
        /// The thing to write instead.
        instead: &'static str,
    },
    /// A place of `COPY`, or of a table, for which there is no store.
    NoStore {
        /// The place.
        place: String,
    },
    /// A folder in which `COPY` cannot make a file.
    Place {
        /// The folder.
        path: String,
        /// The reason.
        source: io::Error,
    },
    /// The result of a query was given up before it was complete.
    Cancelled,
    /// An index of a column or partition that a scan from another process has, and this one does not.
    OutOfRange {
        /// "column" or "partition".
        quantity: &'static str,
        /// The index.
        index: usize,
        /// The number of columns or partitions.
        count: usize,
    },
    /// The sweep cannot be planned or computed, or a file cannot be written.
    Sweep(linkage_sweep_arrow::Error),
    /// DataFusion returned an error.
    Query(DataFusionError),
}

impl EngineError {
    /// The error with the table that it belongs to.
    pub(crate) fn of(self, function: &'static str, mechanism: &str) -> Self {
        match self {
            Self::UnknownMechanism { .. } => self,
            source => Self::Table { function, mechanism: mechanism.to_owned(), source: Box::new(source) },
        }
    }
}

impl fmt::Display for EngineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownMechanism { name, nearest: Some(nearest), .. } => {
                write!(f, "there is no mechanism {name}, did you mean {nearest}?")
            }
            Self::UnknownMechanism { name, known, .. } => {
                write!(f, "there is no mechanism {name}: registered are {}", list(known))
            }
            Self::UnknownBranch { mechanism, name, known } => {
                write!(f, "{mechanism} has no branch {name}: it has {}", list(known))
            }
            Self::Registered { kind, name } => write!(f, "the {kind} {name} is registered twice"),
            Self::ArgumentCount { function, count } => {
                write!(f, "{function} has {count} arguments: it takes the name of a mechanism and a plan in JSON")
            }
            Self::Argument { function, number, meaning, got } => {
                write!(f, "argument {number} of {function} is {got}: it must be a string, {meaning}")
            }
            Self::Request(error) => write!(f, "the plan is not valid: {error}"),
            Self::Table { function, mechanism, source } => write!(f, "{function}('{mechanism}'): {source}"),
            Self::Chunk { mechanism, number, source } => write!(f, "chunk {number} of {mechanism}: {source}"),
            Self::Panic(message) => write!(f, "a function panicked: {message}"),
            Self::Unsupported { part, instead } => write!(f, "{part} is not supported: write {instead}"),
            Self::NoStore { place } => write!(f, "there is no store for {place}: COPY writes files of this machine"),
            Self::Place { path, source } => write!(f, "cannot create a file in {path}: {source}"),
            Self::Cancelled => f.write_str("the query was cancelled before its result was complete"),
            Self::OutOfRange { quantity, index, count } => {
                write!(f, "there is no {quantity} of index {index}: there are {count}")
            }
            Self::Sweep(error) => error.fmt(f),
            Self::Query(error) => match (cause(error), error.find_root()) {
                (Some(error), _) => error.fmt(f),
                (None, DataFusionError::SchemaError(error, _)) => schema(error, f),
                (None, _) => f.write_str(&error.strip_backtrace()),
            },
        }
    }
}

/// The error of this crate that DataFusion hands on.
fn cause(error: &DataFusionError) -> Option<&EngineError> {
    let mut error: Option<&(dyn std::error::Error + 'static)> = Some(error);
    while let Some(this) = error {
        if let Some(found) = this.downcast_ref::<EngineError>() {
            return Some(found);
        }
        error = this.source();
    }
    None
}

/// An error of columns. DataFusion's own message has the names of all columns, of which mechanisms have many.
fn schema(error: &SchemaError, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let SchemaError::FieldNotFound { field, valid_fields } = error else { return write!(f, "{error}") };
    write!(f, "there is no column {}", field.name())?;
    let nearest = nearest(field.name(), valid_fields.iter().map(|field| field.name()));
    nearest.map_or(Ok(()), |nearest| write!(f, ", did you mean {nearest}?"))
}

/// Names with commas between them.
fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

impl std::error::Error for EngineError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Request(error) => Some(error),
            Self::Table { source, .. } | Self::Chunk { source, .. } => Some(source.as_ref()),
            Self::Sweep(error) => std::error::Error::source(error),
            Self::Place { source, .. } => Some(source),
            Self::Query(error) => Some(error),
            _ => None,
        }
    }
}

impl From<SweepError> for EngineError {
    fn from(error: SweepError) -> Self {
        Self::Sweep(error.into())
    }
}

impl From<linkage_sweep_arrow::Error> for EngineError {
    fn from(error: linkage_sweep_arrow::Error) -> Self {
        Self::Sweep(error)
    }
}

impl From<ArrowError> for EngineError {
    fn from(error: ArrowError) -> Self {
        Self::Sweep(error.into())
    }
}

impl From<DataFusionError> for EngineError {
    fn from(error: DataFusionError) -> Self {
        Self::Query(error)
    }
}

impl From<EngineError> for DataFusionError {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Query(error) => error,
            error => Self::External(Box::new(error)),
        }
    }
}
