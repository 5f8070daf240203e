//! Plans as bytes.

use std::sync::Arc;

use ballista_core::serde::BallistaPhysicalExtensionCodec;
use datafusion::common::plan_err;
use datafusion::error::Result;
use datafusion::execution::TaskContext;
use datafusion::physical_plan::ExecutionPlan;
use datafusion_proto::physical_plan::{PhysicalExtensionCodec, PhysicalProtoConverterExtension};

use super::TaskScan;
use crate::{EngineError, Mechanisms, ScanSpec, SweepScan};

/// The first bytes of a scan. No message of Ballista begins with them: in protobuf they would be a field of a wire type
/// that does not exist.
const TAG: &[u8] = b"\x07linkage\n";

/// Scans of tasks as bytes, in addition to the nodes of Ballista: a tag, then the [scan](ScanSpec) in JSON.
#[derive(Debug)]
pub struct SweepCodec {
    mechanisms: Arc<Mechanisms>,
    ballista: BallistaPhysicalExtensionCodec,
}

impl SweepCodec {
    /// A codec of scans of these mechanisms.
    #[must_use]
    pub fn new(mechanisms: Arc<Mechanisms>) -> Self {
        Self { mechanisms, ballista: BallistaPhysicalExtensionCodec::default() }
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
        let Some(json) = bytes.strip_prefix(TAG) else {
            return self.ballista.try_decode(bytes, inputs, context, converter);
        };
        let spec: ScanSpec = serde_json::from_slice(json).map_err(EngineError::Request)?;
        match inputs {
            [numbers] => {
                let scan = SweepScan::new(&self.mechanisms, spec)?;
                Ok(Arc::new(TaskScan::new(scan, Arc::clone(numbers))))
            }
            _ => plan_err!("a scan of a task has {} inputs instead of one", inputs.len()),
        }
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
        Ok(serde_json::to_writer(bytes, task.spec()).map_err(EngineError::Request)?)
    }
}
