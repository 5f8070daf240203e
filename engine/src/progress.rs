//! The progress of a query in this process.

use std::sync::Arc;

use datafusion::physical_plan::ExecutionPlan;

use crate::SweepScan;

/// The chunks of all scans of a query.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ScanProgress {
    /// The number of chunks that are computed.
    pub chunks_done: u64,
    /// The number of chunks. A query with a limit may end before.
    pub chunks: u64,
}

/// The progress of a query, while it runs or after it.
#[must_use]
pub fn progress(plan: &Arc<dyn ExecutionPlan>) -> ScanProgress {
    let own = plan.downcast_ref::<SweepScan>().map_or_else(ScanProgress::default, |scan| ScanProgress {
        chunks_done: scan.chunks_done(),
        chunks: scan.chunks(),
    });
    plan.children().into_iter().map(progress).fold(own, |sum, next| ScanProgress {
        chunks_done: sum.chunks_done + next.chunks_done,
        chunks: sum.chunks + next.chunks,
    })
}
