//! Queries on a Ballista cluster.
//!
//! A cluster has a [`Scheduler`], [executors](executor) and a [`Cluster`] handle for queries. Clients and executors link
//! the same [mechanisms](crate::Mechanisms): a task carries the name of a mechanism, its request in JSON, the columns and
//! the number of a partition, and no rows of the sweep.
//!
//! - Each partition of a scan is a task. It computes the same chunks wherever it runs.
//! - The partitions of an executor that is lost run again on another one, also those that it had finished.
//! - A partition whose chunk fails, also by a panic, runs again; after [`ATTEMPTS`] failures the job fails with the
//!   number of the chunk and the reason.
//! - The last stage of a job is one task, so that its result is complete or not there at all.
//!
//! Executors with other mechanisms than those of the command line are programs of a few lines:
//!
//! ```no_run
//! use linkage_engine::Mechanisms;
//! use linkage_engine::cluster::{ClusterError, ExecutorOptions, executor};
//!
//! #[tokio::main]
//! async fn main() -> Result<(), ClusterError> {
//!     let mechanisms = Mechanisms::built_in()?; // and those that you register
//!     let options = ExecutorOptions { scheduler: "10.0.0.1:50050".to_owned(), ..ExecutorOptions::default() };
//!     executor(mechanisms, options).await
//! }
//! ```

mod client;
mod codec;
mod error;
mod executor;
mod failure;
mod progress;
mod scheduler;
mod task_scan;
mod transport;

pub use client::Cluster;
pub use codec::SweepCodec;
pub use error::ClusterError;
pub use executor::{ExecutorOptions, executor};
pub use progress::ClusterProgress;
pub use scheduler::{Scheduler, SchedulerOptions};
pub use task_scan::TaskScan;

/// The number of failures of a partition that fail a job, and the number of times that a query runs if the executor with
/// its result is lost.
pub const ATTEMPTS: usize = 3;
