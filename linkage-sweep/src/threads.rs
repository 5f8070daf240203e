//! The threads of a sweep.

use std::num::NonZero;
use std::thread::available_parallelism;

use rayon::{Scope, ThreadPool, ThreadPoolBuilder};

use crate::SweepError;

/// The most threads for each core. A thread that waits for a core has a chunk in memory and computes nothing; some more
/// than one for each core hide the waits of a callback.
const PER_CORE: usize = 8;

/// A pool of its own, or rayon's current one.
pub struct Threads(Option<ThreadPool>);

impl Threads {
    /// A pool of this number of threads, or of fewer if there are fewer chunks or cores; without a number the current one.
    pub fn new(count: Option<usize>, chunks: u64) -> Result<Self, SweepError> {
        let most = available_parallelism().map_or(1, NonZero::get).saturating_mul(PER_CORE);
        let pool = |count: usize| {
            let count = at_most(chunks, count.min(most)).max(1);
            ThreadPoolBuilder::new().num_threads(count).build().map_err(SweepError::Threads)
        };
        count.map(pool).transpose().map(Self)
    }

    /// The number of threads that have something to do.
    pub fn count_for(&self, chunks: u64) -> usize {
        at_most(chunks, self.count())
    }

    /// The number of threads.
    pub fn count(&self) -> usize {
        self.0.as_ref().map_or_else(rayon::current_num_threads, ThreadPool::current_num_threads)
    }

    /// Calls a function on the thread of the caller. What it spawns runs on the pool, and has ended when this returns.
    pub fn scope<'s, R>(&self, work: impl FnOnce(&Scope<'s>) -> R) -> R {
        match &self.0 {
            Some(pool) => pool.in_place_scope(work),
            None => rayon::in_place_scope(work),
        }
    }
}

/// The smaller of a number of chunks and a number of threads.
fn at_most(chunks: u64, threads: usize) -> usize {
    usize::try_from(chunks).map_or(threads, |chunks| chunks.min(threads))
}
