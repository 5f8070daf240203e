//! Record batches.

use std::ops::ControlFlow;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, PrimitiveArray, RecordBatch};
use arrow_buffer::{BooleanBuffer, NullBuffer};
use arrow_schema::{Schema, SchemaRef};
use linkage_runtime::Real;
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Chunk, Column, Place, Progress, Sweep, SweepError};

use crate::{Error, Scalar, schema};

/// The rows of a chunk, with the [schema](schema()) of its columns. A found number is null where it does not exist: in
/// rejected rows, and where the quantity itself has no value.
///
/// # Errors
/// [`Error::Schema`] and [`Error::Arrow`], if the schema is of other columns.
pub fn record_batch<M>(schema: &SchemaRef, chunk: &Chunk<M>) -> Result<RecordBatch, Error>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    check(schema, chunk)?;
    let is_whole = chunk.rejected() == 0;
    let flags = chunk.accepted();
    let accepted = if is_whole { BooleanBuffer::new_set(flags.len()) } else { BooleanBuffer::from(flags) };
    let nulls = (!is_whole).then(|| NullBuffer::new(accepted.clone()));
    let array = |place: Place, values: &[M::Scalar]| {
        let nulls = match place {
            Place::Given(_) => None,
            // The coordinates of an accepted row exist.
            Place::Found(column) if column < M::COORDINATES => nulls.clone(),
            Place::Found(_) => existing(values),
        };
        let values = values.to_vec().into();
        PrimitiveArray::<<M::Scalar as Scalar>::Arrow>::try_new(values, nulls).map(|array| Arc::new(array) as ArrayRef)
    };
    let mut arrays = chunk.columns().map(|(place, _, values)| array(place, values)).collect::<Result<Vec<_>, _>>()?;
    arrays.push(Arc::new(BooleanArray::new(accepted, None)));
    Ok(RecordBatch::try_new(Arc::clone(schema), arrays)?)
}

/// The mask of a column; none if all its numbers exist.
fn existing<T: Real>(values: &[T]) -> Option<NullBuffer> {
    let exists: BooleanBuffer = values.iter().map(T::is_finite).collect();
    Some(NullBuffer::new(exists)).filter(|nulls| nulls.null_count() > 0)
}

/// An error if the schema has another column where the chunk has one.
fn check<M: Lanes>(schema: &Schema, chunk: &Chunk<M>) -> Result<(), Error> {
    for (index, (place, name, _)) in chunk.columns().enumerate() {
        let is_found = matches!(place, Place::Found(_));
        let is_it = |field: &str| field == name || (!is_found && field.strip_prefix("given ") == Some(name));
        if !schema.fields().get(index).is_some_and(|field| is_it(field.name()) && field.is_nullable() == is_found) {
            return Err(Error::Schema { index, column: name });
        }
    }
    Ok(())
}

/// Computes a sweep on all cores and hands it over as record batches, one for each chunk, in order, on the thread of the
/// caller. All have the same [schema](schema()). Memory is that of [`Sweep::for_each_chunk`].
///
/// After each batch the callback `progress` is called, which cancels the sweep by `ControlFlow::Break(())`.
///
/// # Errors
/// Those of `take`, of [`schema`](schema()) and of [`Sweep::for_each_chunk`].
pub fn for_each_record_batch<M, E>(
    sweep: &Sweep<M>,
    columns: &[Column],
    progress: impl FnMut(Progress) -> ControlFlow<()>,
    mut take: impl FnMut(RecordBatch) -> Result<(), E>,
) -> Result<(), E>
where
    M: Lanes,
    M::Scalar: Scalar,
    M::Branch: Send + Sync,
    E: From<Error>,
{
    let schema = schema(sweep, columns)?;
    let take = |chunk: &Chunk<M>| take(record_batch(&schema, chunk)?).map_err(Taken);
    sweep.for_each_chunk(columns, progress, take).map_err(|Taken(error)| error)
}

/// The caller's error.
struct Taken<E>(E);

impl<E: From<Error>> From<SweepError> for Taken<E> {
    fn from(error: SweepError) -> Self {
        Error::from(error).into()
    }
}

impl<E: From<Error>> From<Error> for Taken<E> {
    fn from(error: Error) -> Self {
        Self(error.into())
    }
}
