//! The scan of a task.

use std::fmt;
use std::io;
use std::sync::Arc;
use std::task::Poll;

use datafusion::arrow::array::{AsArray, RecordBatch, UInt64Array};
use datafusion::arrow::datatypes::{DataType, Field, Schema, UInt64Type};
use datafusion::common::plan_err;
use datafusion::common::tree_node::{Transformed, TransformedResult, TreeNode, TreeNodeRecursion};
use datafusion::datasource::memory::MemorySourceConfig;
use datafusion::error::{DataFusionError, Result};
use datafusion::execution::{SendableRecordBatchStream, TaskContext};
use datafusion::physical_expr::{EquivalenceProperties, PhysicalExpr};
use datafusion::physical_plan::coalesce_partitions::CoalescePartitionsExec;
use datafusion::physical_plan::execution_plan::{ChildrenPropertiesMode, ReplaceChildrenOptions};
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{
    DisplayAs, DisplayFormatType, ExecutionPlan, ExecutionPlanProperties, Partitioning, PlanProperties,
};
use futures::{StreamExt, TryStreamExt, stream};

use crate::{EngineError, ScanSpec, SweepScan};

/// A scan whose partitions are those that its input names by number.
///
/// A task of Ballista has some partitions of a plan and counts them from 0: the scheduler keeps the partitions of the
/// task in the leaves that it knows, tables in memory among them, and any other leaf stays as it is, so that each task
/// would compute the whole sweep. So the leaf is a table in memory with the numbers of the partitions.
#[derive(Debug)]
pub struct TaskScan {
    spec: ScanSpec,
    scan: Arc<dyn ExecutionPlan>,
    numbers: Arc<dyn ExecutionPlan>,
    properties: Arc<PlanProperties>,
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
        Ok(Self::of(spec, scan, MemorySourceConfig::try_new_exec(&numbers, schema, None)?))
    }

    /// The partitions of a scan that the column of `numbers` names.
    #[must_use]
    pub fn new(scan: SweepScan, numbers: Arc<dyn ExecutionPlan>) -> Self {
        Self::of(scan.spec().clone(), Arc::new(scan), numbers)
    }

    fn of(spec: ScanSpec, scan: Arc<dyn ExecutionPlan>, numbers: Arc<dyn ExecutionPlan>) -> Self {
        let partitioning = Partitioning::UnknownPartitioning(numbers.output_partitioning().partition_count());
        let equivalence = EquivalenceProperties::new(scan.schema());
        let properties = scan.properties().as_ref().clone().with_partitioning(partitioning);
        let properties = Arc::new(properties.with_eq_properties(equivalence));
        Self { spec, scan, numbers, properties }
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
    ///
    /// # Errors
    /// None in practice: that of a traversal.
    pub fn is_needed(plan: &Arc<dyn ExecutionPlan>) -> Result<bool> {
        plan.exists(|node| Ok(node.is::<SweepScan>()))
    }
}

/// A chunk that failed as an error of input and output, the only kind after which Ballista runs a task again. All others
/// fail the job at once.
fn retried(error: DataFusionError) -> DataFusionError {
    match error.find_root() {
        DataFusionError::External(inner) if matches!(inner.downcast_ref(), Some(EngineError::Chunk { .. })) => {
            DataFusionError::IoError(io::Error::other(super::error::Reason(inner.to_string())))
        }
        _ => error,
    }
}

impl DisplayAs for TaskScan {
    fn fmt_as(&self, format: DisplayFormatType, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TaskScan: ")?;
        self.scan.fmt_as(format, f)
    }
}

impl ExecutionPlan for TaskScan {
    fn name(&self) -> &'static str {
        "TaskScan"
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
            Ok([numbers]) => Ok(Arc::new(Self::of(self.spec.clone(), Arc::clone(&self.scan), numbers))),
            Err(children) => plan_err!("a scan of a task has {} inputs instead of one", children.len()),
        }
    }

    fn with_new_children(self: Arc<Self>, children: Vec<Arc<dyn ExecutionPlan>>) -> Result<Arc<dyn ExecutionPlan>> {
        self.replace_children(children, ReplaceChildrenOptions::new(ChildrenPropertiesMode::Recompute))
    }

    fn execute(&self, partition: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        let numbers = self.numbers.execute(partition, Arc::clone(&context))?;
        let (scan, mechanism) = (Arc::clone(&self.scan), self.spec.table.mechanism.clone());
        let partitions = numbers.map(move |numbers| {
            let numbers = numbers?;
            let numbers = numbers.column(0).as_primitive::<UInt64Type>().values().iter();
            let computed = numbers.map(|&number| computed(&scan, &mechanism, number, &context));
            Ok::<_, DataFusionError>(stream::iter(computed.collect::<Vec<_>>()))
        });
        let batches = partitions.try_flatten().try_flatten().map_err(retried);
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
