//! Sweeps of planar linkages as SQL tables, on DataFusion and on a Ballista cluster.
//!
//! ```
//! use linkage_engine::{Mechanisms, session};
//!
//! # #[tokio::main(flavor = "current_thread")]
//! # async fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let context = session(Mechanisms::built_in()?);
//! let query = r#"
//!     SELECT theta2, mu FROM sweep('four_bar', '{"factors": [{"Turn": {"column": "theta2", "count": 360}}]}')
//!     WHERE abs(sin(mu)) > 0.7
//! "#;
//! let rows = context.sql(query).await?.count().await?;
//! assert!(rows > 0 && rows < 360);
//! # Ok(())
//! # }
//! ```
//!
//! Two table functions take the name of a mechanism and a [request](Request) in JSON, which is a plan of
//! [`linkage_sweep`] and a few settings:
//!
//! - `sweep` has a row for each position: its number `row`, the given and the found columns, and `accepted`, which is true
//!   if the position, its rates and its accelerations exist, with any columns in the query. Found numbers of rejected rows
//!   are null; so is a point or an output that does not exist in an accepted row, in its own column.
//! - `cases` has a row for each case, for example for each design: its `case_number`, its `first_row`, the given
//!   numbers of that row, `accepted` if all its rows are, and the [case columns](Family::case_column) of the mechanism.
//!
//! Only the columns that a query asks for are computed, one chunk of rows after the other. A partition of a query takes
//! the next chunk that no other one has taken. A chunk is a pure function of mechanism, request and number, so that no
//! number depends on the partitions.
//!
//! A [cluster] of several processes answers these queries too.

mod batches;
mod cases;
mod chunked;
pub mod cluster;
mod column;
mod error;
mod family;
mod function;
mod handout;
pub mod mechanisms;
mod nearest;
mod positions;
mod print;
mod progress;
mod registry;
mod request;
mod scan;
mod session;
mod spec;
mod table;
mod unsupported;
mod write;

pub use error::EngineError;
pub use family::Family;
// For binaries and examples.
#[doc(hidden)]
pub use print::print;
pub use progress::{ScanProgress, progress};
pub use registry::Mechanisms;
pub use request::Request;
pub use scan::SweepScan;
pub use session::{register, session};
pub use spec::{ScanSpec, TableKind, TableSpec};
pub use table::SweepTable;
pub use write::write_parquet;
