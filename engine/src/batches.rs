//! The batches of one partition.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use datafusion::arrow::array::RecordBatch;
use datafusion::error::Result;
use datafusion::physical_plan::metrics::{BaselineMetrics, Count, RecordOutput};

use crate::EngineError;
use crate::chunked::ChunkReader;
use crate::handout::Numbers;

/// Computes chunks and hands them over in batches. Nothing follows an error.
pub struct Batches {
    pub reader: Box<dyn ChunkReader>,
    /// The name of the mechanism, for errors.
    pub mechanism: String,
    /// The numbers of the chunks to compute.
    pub numbers: Numbers,
    /// The number of rows of all partitions.
    pub rows: u64,
    pub rows_per_chunk: u64,
    pub rows_per_batch: usize,
    /// The rest of a chunk.
    pub ready: Option<RecordBatch>,
    pub metrics: BaselineMetrics,
    /// The number of chunks computed.
    pub done: Count,
}

impl Batches {
    /// Computes a chunk, without the rows beyond the last one.
    fn compute(&mut self, number: u64) -> Result<RecordBatch, EngineError> {
        let _timer = self.metrics.elapsed_compute().timer();
        let read = || self.reader.read(number);
        let chunk = catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|payload| Err(panic(payload.as_ref())));
        let in_chunk =
            |source| EngineError::Chunk { mechanism: self.mechanism.clone(), number, source: Box::new(source) };
        let chunk = chunk.map_err(in_chunk)?;
        self.done.add(1);
        let rest = usize::try_from(self.rows - number * self.rows_per_chunk).unwrap_or(usize::MAX);
        Ok(chunk.slice(0, chunk.num_rows().min(rest)))
    }
}

/// A panic of a function of the user.
fn panic(payload: &(dyn Any + Send)) -> EngineError {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    EngineError::Panic(text.unwrap_or("without a message").to_owned())
}

impl Iterator for Batches {
    type Item = Result<RecordBatch>;

    fn next(&mut self) -> Option<Self::Item> {
        let chunk = match self.ready.take() {
            Some(rest) => rest,
            None => {
                let number = self.numbers.next()?;
                match self.compute(number) {
                    Ok(chunk) => chunk,
                    Err(error) => {
                        self.numbers = Numbers::none();
                        return Some(Err(error.into()));
                    }
                }
            }
        };
        let rows = chunk.num_rows().min(self.rows_per_batch);
        self.ready = (rows < chunk.num_rows()).then(|| chunk.slice(rows, chunk.num_rows() - rows));
        Some(Ok(chunk.slice(0, rows).record_output(&self.metrics)))
    }
}
