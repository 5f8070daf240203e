//! The schema of a sweep.

use std::sync::Arc;

use arrow_array::ArrowPrimitiveType;
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Column, Sweep};

use crate::{Error, Scalar};

/// The key of the mechanism's name in the metadata of a schema.
pub const MECHANISM: &str = "linkage.mechanism";

/// The key of the plan's seed in the metadata of a schema.
pub const SEED: &str = "linkage.seed";

/// The schema of these columns, named as in CSV, then a Boolean column `accepted`.
///
/// Found columns are nullable, as they are null where they do not exist; given columns are not. The metadata has the name of the
/// mechanism at [`MECHANISM`] and the seed of the plan at [`SEED`].
///
/// # Errors
/// Those of [`Sweep::chunk`] for the columns.
pub fn schema<M>(sweep: &Sweep<M>, columns: &[Column]) -> Result<SchemaRef, Error>
where
    M: Lanes,
    M::Scalar: Scalar,
{
    let scalar = <M::Scalar as Scalar>::Arrow::DATA_TYPE;
    let is_found = |column: usize| matches!(columns.get(column), Some(Column::Found(_)));
    let field = |(column, name): (usize, String)| match column < columns.len() {
        true => Field::new(name, scalar.clone(), is_found(column)),
        false => Field::new(name, DataType::Boolean, false),
    };
    let names = linkage_sweep::names::<M>(columns)?;
    let fields: Vec<Field> = names.into_iter().enumerate().map(field).collect();
    let metadata = [(MECHANISM, M::NAME.to_owned()), (SEED, sweep.plan().seed.to_string())];
    let metadata = metadata.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
    Ok(Arc::new(Schema::new_with_metadata(fields, metadata)))
}
