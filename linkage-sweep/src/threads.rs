//! The threads of a sweep.

use rayon::{Scope, ThreadPool, ThreadPoolBuilder};

use crate::SweepError;

/// A pool of its own, or rayon's current one.
pub struct Threads(Option<ThreadPool>);

impl Threads {
    /// A pool of this number of threads, or the current one.
    pub fn new(count: Option<usize>) -> Result<Self, SweepError> {
        let pool = |count| ThreadPoolBuilder::new().num_threads(count).build().map_err(SweepError::Threads);
        count.map(pool).transpose().map(Self)
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
