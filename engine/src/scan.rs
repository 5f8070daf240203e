//! The scan of a table.

use std::fmt;
use std::sync::Arc;

use datafusion::arrow::compute::SortOptions;
use datafusion::common::Statistics;
use datafusion::common::stats::Precision;
use datafusion::common::tree_node::TreeNodeRecursion;
use datafusion::error::Result;
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::expressions::col;
use datafusion::physical_expr::{EquivalenceProperties, PhysicalExpr, PhysicalSortExpr};
use datafusion::physical_plan::coop::cooperative;
use datafusion::physical_plan::execution_plan::{Boundedness, EmissionType, ReplaceChildrenOptions, SchedulingType};
use datafusion::physical_plan::metrics::{BaselineMetrics, ExecutionPlanMetricsSet, MetricBuilder, MetricsSet};
use datafusion::physical_plan::statistics::StatisticsArgs;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{DisplayAs, DisplayFormatType, ExecutionPlan, Partitioning, PlanProperties};
use futures::stream;

use crate::batches::Batches;
use crate::chunked::Chunked;
use crate::handout::Handout;
use crate::{EngineError, Mechanisms, ScanSpec};

/// The metric of the number of chunks that are computed.
pub const CHUNKS: &str = "chunks";

/// A scan of a table.
///
/// In a query of this process a partition takes the next chunk that no other one has taken; the partitions of a scan that
/// is opened by [`new`](Self::new) have the same chunks in each process. A limit is one of all partitions: only the first
/// rows are computed, the last chunk of them as a whole.
#[derive(Debug)]
pub struct SweepScan {
    spec: ScanSpec,
    table: Arc<dyn Chunked>,
    handout: Handout,
    properties: Arc<PlanProperties>,
    metrics: ExecutionPlanMetricsSet,
}

impl SweepScan {
    /// Opens a scan whose partitions several processes may compute: partition p of n has the chunks p, p + n, p + 2n and
    /// so on.
    ///
    /// # Errors
    /// Those of [`SweepTable::new`](crate::SweepTable::new), and [`EngineError::OutOfRange`] if the table does not have
    /// a column of the projection.
    pub fn new(mechanisms: &Mechanisms, spec: ScanSpec) -> Result<Self, EngineError> {
        Self::open(mechanisms.open(&spec.table)?, spec, Handout::Fixed)
    }

    /// The scan without data.
    #[must_use]
    pub fn spec(&self) -> &ScanSpec {
        &self.spec
    }

    /// The number of chunks of all partitions.
    #[must_use]
    pub fn chunks(&self) -> u64 {
        self.rows().div_ceil(self.table.rows_per_chunk())
    }

    /// The number of chunks that are computed in this process.
    #[must_use]
    pub fn chunks_done(&self) -> u64 {
        self.metrics.clone_inner().sum_by_name(CHUNKS).map_or(0, |chunks| chunks.as_usize() as u64)
    }

    /// A scan of an open table.
    pub(crate) fn open(table: Arc<dyn Chunked>, spec: ScanSpec, handout: Handout) -> Result<Self, EngineError> {
        let count = table.schema().fields().len();
        if let Some(&index) = spec.projection.iter().find(|&&index| index >= count) {
            return Err(EngineError::OutOfRange { quantity: "column", index, count });
        }
        let schema = Arc::new(table.schema().project(&spec.projection)?);
        let ascending = |name: &&str| {
            let options = SortOptions { descending: false, nulls_first: false };
            col(name, &schema).ok().map(|column| [PhysicalSortExpr::new(column, options)])
        };
        let orderings: Vec<_> = table.ascending().iter().filter_map(ascending).collect();
        let equivalence = EquivalenceProperties::new_with_orderings(Arc::clone(&schema), orderings);
        let rows = spec.fetch.map_or(table.rows(), |fetch| fetch.min(table.rows()));
        let chunks = usize::try_from(rows.div_ceil(table.rows_per_chunk())).unwrap_or(usize::MAX);
        let spec = ScanSpec { partitions: spec.partitions.clamp(1, chunks.max(1)), ..spec };
        let partitioning = Partitioning::UnknownPartitioning(spec.partitions);
        let properties =
            PlanProperties::new(equivalence, partitioning, EmissionType::Incremental, Boundedness::Bounded)
                .with_scheduling_type(SchedulingType::Cooperative);
        Ok(Self { spec, table, handout, properties: Arc::new(properties), metrics: ExecutionPlanMetricsSet::new() })
    }

    /// The number of rows of all partitions.
    fn rows(&self) -> u64 {
        self.spec.fetch.map_or(self.table.rows(), |fetch| fetch.min(self.table.rows()))
    }
}

impl DisplayAs for SweepScan {
    fn fmt_as(&self, _: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ScanSpec { table, fetch, partitions, .. } = &self.spec;
        let schema = self.schema();
        let columns: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        let (function, mechanism) = (table.kind.function(), &table.mechanism);
        write!(f, "SweepScan: {function}('{mechanism}'), columns=[{}], chunks={}", columns.join(", "), self.chunks())?;
        write!(f, ", partitions={partitions}")?;
        fetch.map_or(Ok(()), |fetch| write!(f, ", fetch={fetch}"))
    }
}

impl ExecutionPlan for SweepScan {
    fn name(&self) -> &'static str {
        "SweepScan"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn children(&self) -> Vec<&Arc<dyn ExecutionPlan>> {
        Vec::new()
    }

    fn apply_expressions(
        &self,
        _: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn replace_children(
        self: Arc<Self>,
        _: Vec<Arc<dyn ExecutionPlan>>,
        _: ReplaceChildrenOptions,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        Ok(self)
    }

    fn with_new_children(self: Arc<Self>, _: Vec<Arc<dyn ExecutionPlan>>) -> Result<Arc<dyn ExecutionPlan>> {
        Ok(self)
    }

    fn execute(&self, partition: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let count = self.spec.partitions;
        if partition >= count {
            return Err(EngineError::OutOfRange { quantity: "partition", index: partition, count }.into());
        }
        let batches = Batches {
            reader: self.table.reader(&self.spec.projection)?,
            mechanism: self.spec.table.mechanism.clone(),
            numbers: self.handout.numbers(self.chunks(), partition, count),
            rows: self.rows(),
            rows_per_chunk: self.table.rows_per_chunk(),
            rows_per_batch: context.session_config().batch_size(),
            ready: None,
            done: MetricBuilder::new(&self.metrics).counter(CHUNKS, partition),
            metrics: BaselineMetrics::new(&self.metrics, partition),
        };
        let stream = RecordBatchStreamAdapter::new(self.schema(), stream::iter(batches));
        Ok(Box::pin(cooperative(stream)))
    }

    fn metrics(&self) -> Option<MetricsSet> {
        Some(self.metrics.clone_inner())
    }

    fn statistics_from_inputs(&self, _: &[Arc<Statistics>], args: &StatisticsArgs) -> Result<Arc<Statistics>> {
        // The rows of a partition are known when it has computed them.
        let rows = args.partition().is_none().then(|| usize::try_from(self.rows()).ok()).flatten();
        let num_rows = rows.map_or(Precision::Absent, Precision::Exact);
        Ok(Arc::new(Statistics { num_rows, ..Statistics::new_unknown(&self.schema()) }))
    }

    fn supports_limit_pushdown(&self) -> bool {
        false
    }

    fn with_fetch(&self, limit: Option<usize>) -> Option<Arc<dyn ExecutionPlan>> {
        let spec = ScanSpec { fetch: limit.map(|limit| limit as u64), ..self.spec.clone() };
        Some(Arc::new(Self::open(Arc::clone(&self.table), spec, self.handout.again()).ok()?))
    }

    fn fetch(&self) -> Option<usize> {
        self.spec.fetch.and_then(|fetch| usize::try_from(fetch).ok())
    }
}
