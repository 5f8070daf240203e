//! Plans as bytes.

use std::sync::Arc;

use ballista_core::serde::BallistaPhysicalExtensionCodec;
use datafusion::arrow::ipc::convert::{IpcSchemaEncoder, fb_to_schema};
use datafusion::arrow::ipc::root_as_schema;
use datafusion::common::{internal_err, plan_err};
use datafusion::error::Result;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::ExecutionPlan;
use datafusion_proto::physical_plan::{PhysicalExtensionCodec, PhysicalProtoConverterExtension};

use super::TaskScan;
use super::task_scan::Scan;
use crate::{EngineError, Mechanisms, ScanSpec, SweepScan};

/// The first bytes of a scan. No message of Ballista begins with them: in protobuf they would be a field of a wire type
/// that does not exist.
const TAG: &[u8] = b"\x07linkage\n";

/// Scans of tasks as bytes, in addition to the nodes of Ballista: a tag, the [scan](ScanSpec) as JSON on one line, and
/// the schema of its rows as a flat buffer of Arrow.
#[derive(Debug, Default)]
pub struct SweepCodec {
    executor: Option<Place>,
    ballista: BallistaPhysicalExtensionCodec,
}

/// An executor.
#[derive(Debug)]
struct Place {
    mechanisms: Mechanisms,
    address: String,
}

impl SweepCodec {
    /// The codec of the executor at this address. That of all other processes is the default.
    #[must_use]
    pub fn of_executor(mechanisms: Mechanisms, address: String) -> Self {
        Self { executor: Some(Place { mechanisms, address }), ..Self::default() }
    }

    /// Opens a scan where it is computed.
    fn open(&self, spec: &ScanSpec, schema: &datafusion::arrow::datatypes::Schema) -> Scan {
        let Some(Place { mechanisms, address }) = &self.executor else {
            return Scan::Closed("only executors compute".to_owned());
        };
        match SweepScan::new(mechanisms, spec.clone()) {
            Ok(scan) if scan.schema().as_ref() == schema => Scan::Open(Arc::new(scan)),
            Ok(_) => {
                let mechanism = &spec.table.mechanism;
                Scan::Closed(format!("the executor at {address} has other columns of {mechanism}: start it anew"))
            }
            Err(error) => Scan::Closed(format!("the executor at {address}: {error}")),
        }
    }
}

impl PhysicalExtensionCodec for SweepCodec {
    fn try_decode(
        &self,
        bytes: &[u8],
        inputs: &[Arc<dyn ExecutionPlan>],
        context: &TaskContext,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let Some(bytes) = bytes.strip_prefix(TAG) else {
            return self.ballista.try_decode(bytes, inputs, context, converter);
        };
        let Some((json, schema)) = bytes.iter().position(|&byte| byte == b'\n').map(|end| bytes.split_at(end)) else {
            return internal_err!("a scan of a task has no schema");
        };
        let spec: ScanSpec = serde_json::from_slice(json).map_err(EngineError::Request)?;
        let schema = match root_as_schema(&schema[1..]) {
            Ok(schema) => Arc::new(fb_to_schema(schema)),
            Err(error) => return internal_err!("the schema of a scan of a task: {error}"),
        };
        let [numbers] = inputs else {
            return plan_err!("a scan of a task has {} inputs instead of one", inputs.len());
        };
        let scan = self.open(&spec, &schema);
        Ok(Arc::new(TaskScan::new(spec, schema, scan, Arc::clone(numbers))))
    }

    fn try_encode(
        &self,
        node: Arc<dyn ExecutionPlan>,
        bytes: &mut Vec<u8>,
        converter: &dyn PhysicalProtoConverterExtension,
    ) -> Result<()> {
        let Some(task) = node.downcast_ref::<TaskScan>() else {
            return self.ballista.try_encode(node, bytes, converter);
        };
        bytes.extend_from_slice(TAG);
        serde_json::to_writer(&mut *bytes, task.spec()).map_err(EngineError::Request)?;
        bytes.push(b'\n');
        bytes.extend_from_slice(IpcSchemaEncoder::new().schema_to_fb(&task.schema()).finished_data());
        Ok(())
    }
}
