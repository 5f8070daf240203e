//! Results as Parquet.

use std::path::Path;

use datafusion::arrow::array::RecordBatch;
use datafusion::execution::SendableRecordBatchStream;
use datafusion::parquet::arrow::ArrowWriter;
use datafusion::parquet::basic::Compression;
use datafusion::parquet::errors::ParquetError;
use datafusion::parquet::file::properties::WriterProperties;
use futures::StreamExt;
use linkage_sweep::write_whole;
use tokio::sync::mpsc;

use crate::EngineError;

/// The number of batches that wait for the writer.
const WAITING: usize = 4;

/// Writes the result of a query as a Parquet file with Snappy compression, and returns the number of rows.
///
/// The file appears when it is complete: on an error there is none, and one that was there before remains, also if the
/// future is dropped. If the path is a symbolic link, it remains, and the file that it leads to is written.
///
/// # Errors
/// [`EngineError::Query`] if the query fails, and [`EngineError::Sweep`] if the file cannot be written.
pub async fn write_parquet(mut batches: SendableRecordBatchStream, path: &Path) -> Result<u64, EngineError> {
    let schema = batches.schema();
    let path = path.to_owned();
    // The end is said too: without it the query was given up, and the file is not complete.
    let (send, mut receive) = mpsc::channel::<Option<Result<RecordBatch, EngineError>>>(WAITING);
    let writer = tokio::task::spawn_blocking(move || {
        let mut rows = 0;
        write_whole(&path, |file| {
            let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
            let mut writer = ArrowWriter::try_new(file, schema, Some(properties)).map_err(failed(&path))?;
            while let Some(batch) = receive.blocking_recv().ok_or(EngineError::Cancelled)? {
                let batch = batch?;
                writer.write(&batch).map_err(failed(&path))?;
                rows += batch.num_rows() as u64;
            }
            writer.finish().map_err(failed(&path))?;
            Ok::<(), EngineError>(())
        })?;
        Ok(rows)
    });
    while let Some(batch) = batches.next().await {
        // The writer has ended with an error if it does not take the batch.
        if send.send(Some(batch.map_err(EngineError::Query))).await.is_err() {
            break;
        }
    }
    // Here too the writer has ended if it does not take it.
    let _ = send.send(None).await;
    writer.await.unwrap_or_else(|error| Err(EngineError::Panic(error.to_string())))
}

/// The error of a writer with the path of the file.
fn failed(path: &Path) -> impl Fn(ParquetError) -> EngineError {
    move |error| match error.into() {
        linkage_sweep_arrow::Error::Io { path: None, attempt, source } => {
            linkage_sweep_arrow::Error::Io { path: Some(path.to_owned()), attempt, source }.into()
        }
        error => error.into(),
    }
}
