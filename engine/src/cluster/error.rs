//! The error of clusters.

use std::fmt;
use std::io;

use ballista_core::error::BallistaError;
use datafusion::error::DataFusionError;

use super::failure::Failure;
use crate::EngineError;

/// The reason why a cluster does not start, or does not answer a query.
#[derive(Debug)]
#[non_exhaustive]
pub enum ClusterError {
    /// A process cannot listen.
    Listen {
        /// "scheduler" or "executor".
        role: &'static str,
        /// The address.
        address: String,
        /// The reason.
        source: io::Error,
    },
    /// A process listens on all networks and has no name for the others.
    NoName,
    /// The address of a scheduler that is not a host and a port.
    Address(String),
    /// There is no scheduler, or it does not answer.
    Unreachable {
        /// The address of the scheduler.
        address: String,
        /// The reason.
        source: io::Error,
    },
    /// A scheduler has too few executors.
    NotReady {
        /// The address of the scheduler.
        address: String,
        /// The time of waiting.
        seconds: u64,
        /// The answer of the scheduler.
        answer: String,
    },
    /// A folder for results of tasks cannot be made.
    Folder(io::Error),
    /// A scheduler or an executor ended.
    Process {
        /// "scheduler" or "executor".
        role: &'static str,
        /// The address.
        address: String,
        /// The reason.
        source: BallistaError,
    },
    /// A job failed.
    Job {
        /// The address of the scheduler.
        address: String,
        /// The reason.
        reason: String,
    },
    /// A query cannot be planned, or its answer cannot be taken.
    Query(EngineError),
}

impl ClusterError {
    /// The error of a job.
    pub(super) fn job(address: &str, error: &DataFusionError) -> Self {
        Self::Job { address: address.to_owned(), reason: Failure::reason(&error.strip_backtrace()) }
    }
}

impl fmt::Display for ClusterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Listen { role, address, source } => write!(f, "the {role} cannot listen at {address}: {source}"),
            Self::NoName => {
                f.write_str("a scheduler at 0.0.0.0 needs a name by which executors reach it: --advertise HOST")
            }
            Self::Address(address) => {
                write!(f, "{address} is not the address of a scheduler: HOST:PORT, for example 127.0.0.1:50050")
            }
            Self::Unreachable { address, source } => {
                write!(f, "the scheduler at {address} does not answer: {source}")
            }
            Self::NotReady { address, seconds, answer } => {
                write!(f, "the scheduler at {address} has too few executors after {seconds} s: {answer}")
            }
            Self::Folder(source) => write!(f, "cannot make a folder for the results of tasks: {source}"),
            Self::Process { role, address, source } => write!(f, "the {role} at {address} ended: {source}"),
            Self::Job { address, reason } => write!(f, "the cluster at {address}: {reason}"),
            Self::Query(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ClusterError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Listen { source, .. } | Self::Unreachable { source, .. } | Self::Folder(source) => Some(source),
            Self::Process { source, .. } => Some(source),
            Self::Query(error) => std::error::Error::source(error),
            _ => None,
        }
    }
}

impl From<EngineError> for ClusterError {
    fn from(error: EngineError) -> Self {
        Self::Query(error)
    }
}

impl From<DataFusionError> for ClusterError {
    fn from(error: DataFusionError) -> Self {
        Self::Query(error.into())
    }
}
