//! Tables with a row for each case.

use std::sync::Arc;

use datafusion::arrow::array::{
    ArrayRef, BooleanArray, Float64Array, PrimitiveArray, RecordBatch, RecordBatchOptions, UInt64Array,
};
use datafusion::arrow::datatypes::{DataType, Field, SchemaRef};
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Block, Case, Chunk, Column, Sweep, given};
use linkage_sweep_arrow::{Scalar, schema};

use crate::EngineError;
use crate::chunked::{ChunkReader, Chunked};
use crate::column::CaseColumn;
use crate::positions::{CASE, compute, with_numbers};

/// The column of the number of the first row.
pub const FIRST_ROW: &str = "first_row";

/// The cases of a sweep.
pub struct Cases<M: Lanes> {
    sweep: Arc<Sweep<M>>,
    schema: SchemaRef,
    parts: Vec<Part<M>>,
}

/// The source of a column.
enum Part<M: Lanes> {
    /// The number of the case.
    Case,
    /// The number of its first row.
    Row,
    /// A given column in its first row.
    Given(usize),
    /// True if all rows of the case are accepted.
    Accepted,
    /// A function of the case.
    Value(CaseColumn<M>),
}

impl<M: Lanes> Clone for Part<M> {
    fn clone(&self) -> Self {
        match self {
            Self::Case => Self::Case,
            Self::Row => Self::Row,
            Self::Given(column) => Self::Given(*column),
            Self::Accepted => Self::Accepted,
            Self::Value(column) => Self::Value(column.clone()),
        }
    }
}

impl<M> Cases<M>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    /// The cases of a sweep, with these functions of them.
    pub fn new(sweep: Sweep<M>, values: Vec<CaseColumn<M>>) -> Result<Self, EngineError> {
        let columns: Vec<Column> = (0..M::GIVEN.len()).map(given).collect();
        let inner = schema(&sweep, &columns)?;
        let of_values = values.iter().map(|value| Arc::new(Field::new(&value.name, DataType::Float64, true)));
        let fields = inner.fields().iter().cloned().chain(of_values);
        let schema = with_numbers(&[CASE, FIRST_ROW], &inner, fields);
        let of_given = (0..M::GIVEN.len()).map(Part::Given);
        let parts = [Part::Case, Part::Row].into_iter().chain(of_given).chain([Part::Accepted]);
        let parts = parts.chain(values.into_iter().map(Part::Value)).collect();
        Ok(Self { sweep: Arc::new(sweep), schema, parts })
    }
}

impl<M> Chunked for Cases<M>
where
    M: Lanes + 'static,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
{
    fn schema(&self) -> SchemaRef {
        Arc::clone(&self.schema)
    }

    fn rows(&self) -> u64 {
        self.sweep.rows() / self.sweep.rows_per_case()
    }

    fn rows_per_chunk(&self) -> u64 {
        // A chunk has whole cases.
        self.sweep.rows_per_chunk() / self.sweep.rows_per_case()
    }

    fn ascending(&self) -> &'static [&'static str] {
        &[CASE, FIRST_ROW]
    }

    fn reader(&self, projection: &[usize]) -> Result<Box<dyn ChunkReader>, EngineError> {
        let parts: Vec<Part<M>> = projection.iter().filter_map(|&index| self.parts.get(index)).cloned().collect();
        let mut columns: Vec<Column> = Vec::new();
        for part in &parts {
            let needed = match part {
                Part::Given(column) => vec![given(*column)],
                Part::Value(value) => value.columns.clone(),
                _ => Vec::new(),
            };
            for column in needed {
                // A column may be asked for by name and by index.
                let place = column.place::<M>()?;
                let is_there = |other: &Column| other.place::<M>().is_ok_and(|other| other == place);
                if !columns.iter().any(is_there) {
                    columns.push(column);
                }
            }
        }
        let schema = Arc::new(self.schema.project(projection)?);
        Ok(Box::new(Reader { sweep: Arc::clone(&self.sweep), schema, parts, columns, chunk: None }))
    }
}

/// Computes the cases of chunks.
struct Reader<M: Lanes> {
    sweep: Arc<Sweep<M>>,
    schema: SchemaRef,
    parts: Vec<Part<M>>,
    /// The columns that the parts need.
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
        let rows_per_case = self.sweep.rows_per_case();
        let first = number.saturating_mul(self.sweep.rows_per_chunk());
        let rows = self.sweep.rows_per_chunk().min(self.sweep.rows().saturating_sub(first));
        let cases = first / rows_per_case..(first + rows) / rows_per_case;
        let is_computed = |part: &Part<M>| !matches!(part, Part::Case | Part::Row);
        let block = match self.parts.iter().any(is_computed) {
            true => Some(self.sweep.block(compute(&self.sweep, &self.columns, &mut self.chunk, number)?)),
            false => None,
        };
        let of_block = |part: &dyn Fn(&Block<'_, M>) -> Result<ArrayRef, EngineError>| block.as_ref().map(part);
        let arrays = self.parts.iter().filter_map(|part| match part {
            Part::Case => Some(Ok(Arc::new(UInt64Array::from_iter_values(cases.clone())) as ArrayRef)),
            Part::Row => {
                let rows = cases.clone().map(|case| case * rows_per_case);
                Some(Ok(Arc::new(UInt64Array::from_iter_values(rows)) as ArrayRef))
            }
            Part::Given(column) => of_block(&|block| first_numbers(block, *column)),
            Part::Accepted => of_block(&|block| Ok(Arc::new(accepted(block)))),
            Part::Value(value) => of_block(&|block| Ok(Arc::new(Float64Array::from((value.values)(block)?)))),
        });
        let arrays = arrays.collect::<Result<Vec<ArrayRef>, EngineError>>()?;
        let options = RecordBatchOptions::new().with_row_count(Some((cases.end - cases.start) as usize));
        Ok(RecordBatch::try_new_with_options(Arc::clone(&self.schema), arrays, &options)?)
    }
}

/// The numbers of a given column in the first row of each case.
fn first_numbers<M>(block: &Block<'_, M>, column: usize) -> Result<ArrayRef, EngineError>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    let place = given(column).place::<M>()?;
    let numbers = block.cases([place]).filter_map(|Case { columns: [numbers], .. }| numbers.first().copied());
    Ok(Arc::new(PrimitiveArray::<<M::Scalar as Scalar>::Arrow>::from_iter_values(numbers)))
}

/// True for each case of which all rows are accepted.
fn accepted<M: Lanes>(block: &Block<'_, M>) -> BooleanArray {
    let accepted = block.cases([]).map(|case| case.accepted.iter().all(|accepted| *accepted));
    BooleanArray::from(accepted.collect::<Vec<bool>>())
}
