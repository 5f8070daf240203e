//! Progress and cancellation.

use std::ops::ControlFlow;

use linkage_runtime::lanes::Lanes;

use crate::{Sweep, SweepError};

/// The progress of a sweep, after one more chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Progress {
    /// The rows done.
    pub rows_done: u64,
    /// The rows of the sweep.
    pub rows: u64,
    /// The chunks done.
    pub chunks_done: u64,
    /// The chunks of the sweep.
    pub chunks: u64,
    /// The rejected ones of the rows done.
    pub rejected: u64,
}

impl Progress {
    /// Counts one more chunk and calls back.
    pub(crate) fn advance(
        &mut self,
        rows: usize,
        rejected: usize,
        callback: &mut dyn FnMut(Self) -> ControlFlow<()>,
    ) -> Result<(), SweepError> {
        self.rows_done += rows as u64;
        self.chunks_done += 1;
        self.rejected += rejected as u64;
        match callback(*self) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(SweepError::Cancelled { rows_done: self.rows_done, rows: self.rows }),
        }
    }
}

impl<M: Lanes> Sweep<M> {
    /// The progress before the first chunk.
    pub(crate) fn start(&self) -> Progress {
        Progress { rows_done: 0, rows: self.rows(), chunks_done: 0, chunks: self.chunks(), rejected: 0 }
    }
}
