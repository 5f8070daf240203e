//! The scan of a task.

use std::fmt;
use std::sync::Arc;
use std::task::Poll;

use datafusion::arrow::array::{AsArray, RecordBatch, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Schema, SchemaRef, UInt64Type};
use datafusion::common::plan_err;
use datafusion::common::tree_node::{Transformed, TransformedResult, TreeNode, TreeNodeRecursion};
use datafusion::datasource::memory::MemorySourceConfig;
use datafusion::error::{DataFusionError, Result};
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::{EquivalenceProperties, PhysicalExpr};
use datafusion::physical_plan::coalesce_partitions::CoalescePartitionsExec;
use datafusion::physical_plan::execution_plan::{
    Boundedness, ChildrenPropertiesMode, EmissionType, ReplaceChildrenOptions,
};
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{
    DisplayAs, DisplayFormatType, ExecutionPlan, ExecutionPlanProperties, Partitioning, PlanProperties,
};
use futures::{StreamExt, TryStreamExt, stream};

use super::failure::Failure;
use crate::{ScanSpec, SweepScan};

/// The name in plans.
const NAME: &str = "TaskScan";

/// A scan whose partitions are those that its input names by number.
///
/// A task of Ballista has some partitions of a plan and counts them from 0: the scheduler keeps the partitions of the
/// task in the leaves that it knows, tables in memory among them, and any other leaf stays as it is, so that each task
/// would compute the whole sweep. So the leaf is a table in memory with the numbers of the partitions.
#[derive(Debug)]
pub struct TaskScan {
    spec: ScanSpec,
    scan: Scan,
    numbers: Arc<dyn ExecutionPlan>,
    properties: Arc<PlanProperties>,
}

/// The scan of all partitions.
#[derive(Debug, Clone)]
pub(super) enum Scan {
    /// In a client or an executor.
    Open(Arc<dyn ExecutionPlan>),
    /// In a process that does not compute, or cannot for this reason.
    Closed(String),
}

impl TaskScan {
    /// All partitions of a scan.
    fn all(spec: ScanSpec, scan: Arc<dyn ExecutionPlan>) -> Result<Self> {
        let schema = Arc::new(Schema::new(vec![Field::new("partition", DataType::UInt64, false)]));
        let number = |number: usize| {
            let numbers = UInt64Array::from_value(number as u64, 1);
            Ok(vec![RecordBatch::try_new(Arc::clone(&schema), vec![Arc::new(numbers)])?])
        };
        let numbers = (0..spec.partitions).map(number).collect::<Result<Vec<_>>>()?;
        let numbers = MemorySourceConfig::try_new_exec(&numbers, schema, None)?;
        Ok(Self::new(spec, scan.schema(), Scan::Open(scan), numbers))
    }

    /// The partitions of a scan that the first column of `numbers` names.
    pub(super) fn new(spec: ScanSpec, schema: SchemaRef, scan: Scan, numbers: Arc<dyn ExecutionPlan>) -> Self {
        let partitioning = Partitioning::UnknownPartitioning(numbers.output_partitioning().partition_count());
        let properties = PlanProperties::new(
            EquivalenceProperties::new(schema),
            partitioning,
            EmissionType::Incremental,
            Boundedness::Bounded,
        );
        Self { spec, scan, numbers, properties: Arc::new(properties) }
    }

    /// The scan of all partitions, without data.
    #[must_use]
    pub fn spec(&self) -> &ScanSpec {
        &self.spec
    }

    /// A plan as it is sent to a cluster: the scans are those of tasks, and the last stage is one task. An executor that
    /// is lost after it finished a part of the last stage would leave its part of the result in the answer of Ballista
    /// 55 next to the one that replaces it.
    ///
    /// # Errors
    /// Those of Arrow for a table in memory.
    pub fn distribute(plan: Arc<dyn ExecutionPlan>) -> Result<Arc<dyn ExecutionPlan>> {
        let open = |node: Arc<dyn ExecutionPlan>| {
            let Some(spec) = node.downcast_ref::<SweepScan>().map(|scan| scan.spec().clone()) else {
                return Ok(Transformed::no(node));
            };
            Ok(Transformed::yes(Arc::new(Self::all(spec, node)?) as Arc<dyn ExecutionPlan>))
        };
        let plan = plan.transform_up(open).data()?;
        Ok(match plan.output_partitioning().partition_count() {
            1 => plan,
            _ => Arc::new(CoalescePartitionsExec::new(plan)),
        })
    }

    /// True if a plan reads a sweep.
    #[must_use]
    pub fn is_needed(plan: &Arc<dyn ExecutionPlan>) -> bool {
        plan.is::<SweepScan>() || plan.children().into_iter().any(Self::is_needed)
    }

    /// The number of partitions of all scans of a plan that is sent to a cluster.
    #[must_use]
    pub fn partitions(plan: &Arc<dyn ExecutionPlan>) -> usize {
        let own = plan.downcast_ref::<Self>().map_or(0, |scan| scan.spec.partitions);
        own + plan.children().into_iter().map(Self::partitions).sum::<usize>()
    }

    /// True if the text of a plan, as the scheduler prints it, has such a scan.
    pub(super) fn is_in(plan: &str) -> bool {
        plan.contains(&format!("{NAME}: "))
    }
}

impl DisplayAs for TaskScan {
    fn fmt_as(&self, format: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.scan {
            Scan::Open(scan) => scan.fmt_as(format, f),
            Scan::Closed(_) => write!(f, "{NAME}: {}", self.spec.table.mechanism),
        }
    }
}

impl ExecutionPlan for TaskScan {
    fn name(&self) -> &'static str {
        NAME
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn children(&self) -> Vec<&Arc<dyn ExecutionPlan>> {
        vec![&self.numbers]
    }

    fn apply_expressions(
        &self,
        _: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        Ok(TreeNodeRecursion::Continue)
    }

    fn replace_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
        _: ReplaceChildrenOptions,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        match <[_; 1]>::try_from(children) {
            Ok([numbers]) => Ok(Arc::new(Self::new(self.spec.clone(), self.schema(), self.scan.clone(), numbers))),
            Err(children) => plan_err!("a scan of a task has {} inputs instead of one", children.len()),
        }
    }

    fn with_new_children(self: Arc<Self>, children: Vec<Arc<dyn ExecutionPlan>>) -> Result<Arc<dyn ExecutionPlan>> {
        self.replace_children(children, ReplaceChildrenOptions::new(ChildrenPropertiesMode::Recompute))
    }

    fn execute(&self, partition: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let scan = match &self.scan {
            Scan::Open(scan) => Arc::clone(scan),
            Scan::Closed(reason) => return Err(Failure::of_job(reason.clone())),
        };
        let mechanism = self.spec.table.mechanism.clone();
        let numbers = self.numbers.execute(partition, Arc::clone(&context))?;
        let partitions = numbers.map(move |numbers| {
            let numbers = numbers?;
            let numbers = numbers.column(0).as_primitive::<UInt64Type>().values().iter();
            let computed = numbers.map(|&number| computed(&scan, &mechanism, number, &context));
            Ok::<_, DataFusionError>(stream::iter(computed.collect::<Vec<_>>()))
        });
        let batches = partitions.try_flatten().try_flatten().map_err(Failure::of_chunk);
        Ok(Box::pin(RecordBatchStreamAdapter::new(self.schema(), batches)))
    }
}

/// The batches of a partition. The log has a line when it begins and one when it ends.
fn computed(
    scan: &Arc<dyn ExecutionPlan>,
    mechanism: &str,
    number: u64,
    context: &Arc<TaskContext>,
) -> Result<SendableRecordBatchStream> {
    let name = format!("partition {number} of {mechanism}");
    let batches = scan.execute(usize::try_from(number).unwrap_or(usize::MAX), Arc::clone(context))?;
    let schema = batches.schema();
    let begin = name.clone();
    let begin = stream::poll_fn(move |_| {
        log::debug!("{begin} begins");
        Poll::Ready(None)
    });
    let end = stream::poll_fn(move |_| {
        log::debug!("{name} ends");
        Poll::Ready(None)
    });
    Ok(Box::pin(RecordBatchStreamAdapter::new(schema, begin.chain(batches).chain(end))))
}
