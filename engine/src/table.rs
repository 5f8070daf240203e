//! Tables that DataFusion scans.

use std::sync::Arc;

use async_trait::async_trait;
use datafusion::arrow::datatypes::SchemaRef;
use datafusion::catalog::{Session, TableProvider};
use datafusion::error::Result;
use datafusion::logical_expr::{Expr, TableType};
use datafusion::physical_plan::ExecutionPlan;

use crate::chunked::Chunked;
use crate::handout::Handout;
use crate::{EngineError, Mechanisms, ScanSpec, SweepScan, TableSpec};

/// All positions or cases of a sweep as a table.
#[derive(Debug, Clone)]
pub struct SweepTable {
    spec: TableSpec,
    table: Arc<dyn Chunked>,
}

impl SweepTable {
    /// Opens a table.
    ///
    /// # Errors
    /// [`EngineError::UnknownMechanism`], or [`EngineError::Table`] with the reason: a plan that does not suit the
    /// mechanism, a branch that it does not have, or a column that is named twice.
    pub fn new(mechanisms: &Mechanisms, spec: TableSpec) -> Result<Self, EngineError> {
        let table = mechanisms.open(&spec)?;
        Ok(Self { spec, table })
    }

    /// The table without data.
    #[must_use]
    pub fn spec(&self) -> &TableSpec {
        &self.spec
    }
}

#[async_trait]
impl TableProvider for SweepTable {
    fn schema(&self) -> SchemaRef {
        self.table.schema()
    }

    fn table_type(&self) -> TableType {
        TableType::Base
    }

    async fn scan(
        &self,
        state: &dyn Session,
        projection: Option<&Vec<usize>>,
        _filters: &[Expr],
        limit: Option<usize>,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let all = || (0..self.schema().fields().len()).collect();
        let spec = ScanSpec {
            table: self.spec.clone(),
            projection: projection.cloned().unwrap_or_else(all),
            fetch: limit.map(|limit| limit as u64),
            partitions: state.config().target_partitions(),
        };
        Ok(Arc::new(SweepScan::open(Arc::clone(&self.table), spec, Handout::shared())?))
    }
}
