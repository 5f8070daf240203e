//! A column of the cases of a mechanism.

use std::fmt::{self, Debug};
use std::sync::Arc;

use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Block, Column, SweepError};

/// A number of each case.
pub struct CaseColumn<M: Lanes> {
    pub name: String,
    /// The columns that it needs.
    pub columns: Vec<Column>,
    pub values: Arc<CaseValues<M>>,
}

/// The numbers of all cases of a chunk.
type CaseValues<M> = dyn Fn(&Block<'_, M>) -> Result<Vec<Option<f64>>, SweepError> + Send + Sync;

impl<M: Lanes> Clone for CaseColumn<M> {
    fn clone(&self) -> Self {
        Self { name: self.name.clone(), columns: self.columns.clone(), values: Arc::clone(&self.values) }
    }
}

impl<M: Lanes> Debug for CaseColumn<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CaseColumn").field("name", &self.name).field("columns", &self.columns).finish_non_exhaustive()
    }
}
