//! Sweeps of planar linkages as Arrow record batches and Parquet files.
//!
//! A [`Sweep`](linkage_sweep::Sweep) becomes
//!
//! - a Parquet [file](write_parquet), which DuckDB, Polars, pandas and DataFusion read;
//! - [record batches](for_each_record_batch) in order, for any other user of Arrow;
//! - or single [record batches](record_batch) of chunks.
//!
//! All have the same [schema](schema()): the columns asked for, then a Boolean column `accepted`. A row is accepted if its
//! position, its rates and its accelerations exist, with any columns asked for. Found numbers of rejected rows are null, and
//! so is a point or an output that does not exist in an accepted row, in its own column; none is NaN.
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use linkage::{Elbow, linkage};
//! use linkage_sweep::{Plan, Sweep, found, given};
//! use linkage_sweep_arrow::{Options, write_parquet};
//!
//! linkage! {
//!     /// Crank a, coupler b, rocker c, ground d.
//!     mechanism FourBar {
//!         param a = 40, b = 120, c = 80, d = 100;
//!         input theta2;
//!         unknown theta3, theta4;
//!         loop a@theta2 + b@theta3 = c@theta4 + d@0;
//!         output mu = theta4 - theta3;
//!         derive lanes;
//!     }
//! }
//!
//! // A turn of 50 cranks; the longest do not assemble everywhere.
//! let plan = Plan::new().grid("a", 30.0, 80.0, 50).turn("theta2", 360);
//! let sweep = Sweep::new(&FourBar::<f64>::default(), FourBarBranch::new(Elbow::Left), plan)?;
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("turns.parquet");
//! let columns = [given("a"), given("theta2"), found("theta4"), found("mu")];
//! write_parquet(&sweep, &path, &columns, &Options::default(), |_| ControlFlow::Continue(()))?;
//! assert!(path.exists());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The crates [`arrow_array`], [`arrow_schema`] and [`parquet`] are of version 59, that of DataFusion 55.

#![warn(missing_docs)]

mod batch;
mod error;
mod options;
mod scalar;
mod schema;
mod write;

pub use arrow_array;
pub use arrow_schema;
pub use parquet;

pub use batch::{for_each_record_batch, record_batch};
pub use error::Error;
pub use options::{Compression, Options};
pub use scalar::Scalar;
pub use schema::{MECHANISM, SEED, schema};
pub use write::{write_parquet, write_parquet_to};
