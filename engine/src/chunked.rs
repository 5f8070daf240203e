//! Tables that are computed chunk by chunk.

use std::fmt::{self, Debug};

use datafusion::arrow::array::RecordBatch;
use datafusion::arrow::datatypes::SchemaRef;

use crate::EngineError;

/// A table whose rows are computed when they are read.
pub trait Chunked: Send + Sync {
    /// All columns.
    fn schema(&self) -> SchemaRef;
    /// The number of rows.
    fn rows(&self) -> u64;
    /// The number of rows of each chunk but the last, which may have fewer.
    fn rows_per_chunk(&self) -> u64;
    /// The columns by which the rows ascend strictly.
    fn ascending(&self) -> &'static [&'static str];
    /// A reader of the columns with these indices in the schema.
    fn reader(&self, projection: &[usize]) -> Result<Box<dyn ChunkReader>, EngineError>;
}

impl Debug for dyn Chunked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = f.debug_struct("Chunked");
        table.field("rows", &self.rows()).field("rows_per_chunk", &self.rows_per_chunk()).finish_non_exhaustive()
    }
}

/// Computes chunks with some columns. It uses its memory again.
pub trait ChunkReader: Send {
    /// Computes the chunk of this number.
    fn read(&mut self, number: u64) -> Result<RecordBatch, EngineError>;
}
