//! Sweeps as Parquet.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::Schema;
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Column, Progress, Sweep, write_whole};
use parquet::arrow::ArrowWriter;
use parquet::basic;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::schema::types::ColumnPath;

use crate::{Compression, Error, Options, Scalar, for_each_record_batch, schema};

/// The most bytes of a row group before encoding, by default.
const BYTES: usize = 1 << 26;
/// The most rows of a row group, by default.
const ROWS: usize = 1 << 20;

/// Writes these columns of a sweep and the column `accepted` as a Parquet file, with the [schema](schema()) of record
/// batches.
///
/// The file appears when it is complete: on an error or after a cancellation there is none, and one that was there before
/// remains. Its bytes depend on the sweep, its rows per chunk, the columns and the options, not on the number of threads.
///
/// After each chunk the callback `progress` is called, which cancels the sweep by `ControlFlow::Break(())`.
///
/// # Errors
/// [`Error::Io`], [`SweepError::NotAFile`](linkage_sweep::SweepError::NotAFile), [`Error::Parquet`], and those of
/// [`for_each_record_batch`].
pub fn write_parquet<M>(
    sweep: &Sweep<M>,
    path: impl AsRef<Path>,
    columns: &[Column],
    options: &Options,
    progress: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<(), Error>
where
    M: Lanes,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    let path = path.as_ref();
    write_whole(path, |file| {
        write_parquet_to(sweep, file, columns, options, progress).map_err(|error: Error| error.at(path))
    })
}

/// Writes Parquet, as [`write_parquet`], to a writer.
///
/// # Errors
/// Those of [`write_parquet`].
pub fn write_parquet_to<M>(
    sweep: &Sweep<M>,
    writer: impl Write + Send,
    columns: &[Column],
    options: &Options,
    progress: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<(), Error>
where
    M: Lanes,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    let schema = schema(sweep, columns)?;
    let row = columns.len() * size_of::<M::Scalar>() + 1;
    let rows = options.rows_per_group.unwrap_or((BYTES / row).clamp(1, ROWS));
    let properties = properties(&schema, options, rows);
    let mut writer = ArrowWriter::try_new(writer, Arc::clone(&schema), Some(properties))?;
    for_each_record_batch(sweep, columns, progress, |batch| write(&mut writer, &batch, rows))?;
    // With a flush.
    writer.finish()?;
    Ok(())
}

/// Writes a batch in parts that are not larger than a row group: the writer divides larger ones by recursion.
fn write(writer: &mut ArrowWriter<impl Write + Send>, batch: &RecordBatch, rows: usize) -> Result<(), Error> {
    for first in (0..batch.num_rows()).step_by(rows) {
        writer.write(&batch.slice(first, rows.min(batch.num_rows() - first)))?;
    }
    Ok(())
}

/// The properties of a file.
fn properties(schema: &Schema, options: &Options, rows: usize) -> WriterProperties {
    let mut metadata: Vec<_> = schema.metadata().iter().collect();
    // A map has no order.
    metadata.sort_unstable();
    let metadata = metadata.into_iter().map(|(key, value)| KeyValue::new(key.clone(), value.clone())).collect();
    let compression = match options.compression {
        Compression::Snappy => basic::Compression::SNAPPY,
        Compression::None => basic::Compression::UNCOMPRESSED,
    };
    let mut properties = WriterProperties::builder()
        .set_compression(compression)
        .set_max_row_group_row_count(Some(rows))
        .set_key_value_metadata(Some(metadata));
    for field in schema.fields().iter().filter(|field| field.is_nullable()) {
        // Found numbers hardly repeat: without dictionaries they take less time and space.
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(field.name().as_str()), false);
    }
    properties.build()
}
