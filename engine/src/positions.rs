//! Tables with a row for each position.

use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, PrimitiveArray, RecordBatch, RecordBatchOptions, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Schema, SchemaRef};
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Chunk, Column, Sweep, found, given};
use linkage_sweep_arrow::{Scalar, record_batch, schema};

use crate::EngineError;
use crate::chunked::{ChunkReader, Chunked};

/// The column of the number of a row.
pub const ROW: &str = "row";
/// The column of the number of a case.
pub const CASE: &str = "case_number";

/// All positions of a sweep.
pub struct Positions<M: Lanes> {
    sweep: Arc<Sweep<M>>,
    schema: SchemaRef,
    columns: Vec<Part>,
}

/// The source of a column.
#[derive(Clone)]
enum Part {
    /// The number of the row.
    Row,
    /// The number of its case.
    Case,
    /// A given column by its index.
    Given(usize),
    /// A found column by its index.
    Found(usize),
    /// The mask.
    Accepted,
}

/// The fields of numbers of rows and cases, then other fields; with the metadata of a schema.
pub fn with_numbers(names: &[&str], schema: &Schema, fields: impl IntoIterator<Item = Arc<Field>>) -> SchemaRef {
    let numbers = names.iter().map(|name| Arc::new(Field::new(*name, DataType::UInt64, false)));
    let fields: Vec<_> = numbers.chain(fields).collect();
    Arc::new(Schema::new_with_metadata(fields, schema.metadata().clone()))
}

impl<M> Positions<M>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    /// The positions of a sweep, with the numbers of cases if there are any.
    pub fn new(sweep: Sweep<M>, has_cases: bool) -> Result<Self, EngineError> {
        let numbers = if has_cases { &[ROW, CASE][..] } else { &[ROW] };
        let inner = schema(&sweep, &Column::all::<M>())?;
        let schema = with_numbers(numbers, &inner, inner.fields().iter().cloned());
        let first = [Part::Row, Part::Case].into_iter().take(numbers.len());
        let of_sweep = (0..M::GIVEN.len()).map(Part::Given).chain((0..M::FOUND.len()).map(Part::Found));
        let columns = first.chain(of_sweep).chain([Part::Accepted]).collect();
        Ok(Self { sweep: Arc::new(sweep), schema, columns })
    }
}

impl<M> Chunked for Positions<M>
where
    M: Lanes + 'static,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    fn schema(&self) -> SchemaRef {
        Arc::clone(&self.schema)
    }

    fn rows(&self) -> u64 {
        self.sweep.rows()
    }

    fn rows_per_chunk(&self) -> u64 {
        self.sweep.rows_per_chunk()
    }

    fn ascending(&self) -> &'static [&'static str] {
        &[ROW]
    }

    fn reader(&self, projection: &[usize]) -> Result<Box<dyn ChunkReader>, EngineError> {
        let parts: Vec<Part> = projection.iter().filter_map(|&index| self.columns.get(index)).cloned().collect();
        let columns = |part: &Part| match part {
            Part::Given(index) => Some(given(*index)),
            Part::Found(index) => Some(found(*index)),
            _ => None,
        };
        let columns: Vec<Column> = parts.iter().filter_map(columns).collect();
        Ok(Box::new(Reader {
            sweep: Arc::clone(&self.sweep),
            schema: Arc::new(self.schema.project(projection)?),
            inner: schema(&self.sweep, &columns)?,
            parts,
            columns,
            chunk: None,
        }))
    }
}

/// Computes the positions of chunks.
struct Reader<M: Lanes> {
    sweep: Arc<Sweep<M>>,
    schema: SchemaRef,
    /// The schema of the columns of the sweep, then `accepted`.
    inner: SchemaRef,
    parts: Vec<Part>,
    columns: Vec<Column>,
    chunk: Option<Chunk<M>>,
}

impl<M> ChunkReader for Reader<M>
where
    M: Lanes,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    fn read(&mut self, number: u64) -> Result<RecordBatch, EngineError> {
        let has_positions = self.parts.iter().any(|part| matches!(part, Part::Found(_) | Part::Accepted));
        let batch = match has_positions {
            true => Some(record_batch(&self.inner, compute(&self.sweep, &self.columns, &mut self.chunk, number)?)?),
            false => None,
        };
        let first = number.saturating_mul(self.sweep.rows_per_chunk());
        let rows = self.sweep.rows_per_chunk().min(self.sweep.rows().saturating_sub(first));
        let rows_per_case = self.sweep.rows_per_case();
        // Columns come in the order asked for, then `accepted`.
        let mut computed = batch.iter().flat_map(RecordBatch::columns).cloned().map(Ok);
        let numbers = |number: &dyn Fn(u64) -> u64| -> ArrayRef {
            Arc::new(UInt64Array::from_iter_values((first..first + rows).map(number)))
        };
        let arrays = self.parts.iter().filter_map(|part| match part {
            Part::Row => Some(Ok(numbers(&|row| row))),
            Part::Case => Some(Ok(numbers(&|row| row / rows_per_case))),
            Part::Given(index) if !has_positions => Some(given_numbers(&self.sweep, *index, first, rows)),
            Part::Given(_) | Part::Found(_) => computed.next(),
            Part::Accepted => batch.as_ref().and_then(|batch| batch.columns().last()).cloned().map(Ok),
        });
        let arrays = arrays.collect::<Result<Vec<ArrayRef>, EngineError>>()?;
        let options = RecordBatchOptions::new().with_row_count(Some(rows as usize));
        Ok(RecordBatch::try_new_with_options(Arc::clone(&self.schema), arrays, &options)?)
    }
}

/// A given column, without positions.
fn given_numbers<M>(sweep: &Sweep<M>, index: usize, first: u64, rows: u64) -> Result<ArrayRef, EngineError>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    let mut numbers = vec![M::Scalar::default(); rows as usize];
    sweep.given_numbers(index, first, &mut numbers)?;
    Ok(Arc::new(PrimitiveArray::<<M::Scalar as Scalar>::Arrow>::new(numbers.into(), None)))
}

/// Computes a chunk, in the memory of the one before.
pub fn compute<'a, M: Lanes>(
    sweep: &Sweep<M>,
    columns: &[Column],
    chunk: &'a mut Option<Chunk<M>>,
    number: u64,
) -> Result<&'a Chunk<M>, EngineError> {
    let next = match chunk.take() {
        Some(mut chunk) => {
            sweep.compute(number, &mut chunk)?;
            chunk
        }
        None => sweep.chunk(number, columns)?,
    };
    Ok(chunk.insert(next))
}
