//! The chunks that each partition of a scan computes.

use std::iter::StepBy;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The rule by which chunks go to partitions.
#[derive(Debug)]
pub enum Handout {
    /// Partition p of n computes the chunks p, p + n, p + 2n and so on, in whatever process.
    Fixed,
    /// Each partition takes the next chunk when it has computed one, so that none waits for a slower one.
    Shared(Mutex<Executions>),
}

impl Handout {
    /// A rule for the partitions of one process.
    pub fn shared() -> Self {
        Self::Shared(Mutex::default())
    }

    /// This rule for another scan.
    pub fn again(&self) -> Self {
        match self {
            Self::Fixed => Self::Fixed,
            Self::Shared(_) => Self::shared(),
        }
    }

    /// The chunks of a partition that begins to compute.
    pub fn numbers(&self, chunks: u64, partition: usize, partitions: usize) -> Numbers {
        match self {
            Self::Fixed => Numbers::Fixed((partition as u64..chunks).step_by(partitions)),
            Self::Shared(executions) => {
                let mut executions = executions.lock().unwrap_or_else(PoisonError::into_inner);
                Numbers::Shared { next: executions.enter(partition, partitions), chunks }
            }
        }
    }
}

/// The executions of a scan: the k-th one of a partition belongs to the k-th one of the scan. So a plan may be executed
/// again, but not twice at the same time.
#[derive(Debug, Default)]
pub struct Executions {
    /// The next chunk of each execution.
    next: Vec<Arc<AtomicU64>>,
    /// The number of executions of each partition.
    entered: Vec<usize>,
}

impl Executions {
    /// The next chunk of the execution that a partition enters.
    fn enter(&mut self, partition: usize, partitions: usize) -> Arc<AtomicU64> {
        self.entered.resize(partitions, 0);
        let execution = self.entered[partition];
        self.entered[partition] += 1;
        if execution == self.next.len() {
            self.next.push(Arc::default());
        }
        Arc::clone(&self.next[execution])
    }
}

/// The chunks of a partition, in ascending order.
#[derive(Debug)]
pub enum Numbers {
    /// Those of this partition alone.
    Fixed(StepBy<Range<u64>>),
    /// Those that no partition has taken yet.
    Shared {
        /// The next one.
        next: Arc<AtomicU64>,
        /// The number of chunks.
        chunks: u64,
    },
}

impl Numbers {
    /// No chunks.
    pub fn none() -> Self {
        Self::Fixed((0..0).step_by(1))
    }
}

impl Iterator for Numbers {
    type Item = u64;

    fn next(&mut self) -> Option<u64> {
        match self {
            Self::Fixed(numbers) => numbers.next(),
            Self::Shared { next, chunks } => {
                let number = next.fetch_add(1, Ordering::Relaxed);
                (number < *chunks).then_some(number)
            }
        }
    }
}
