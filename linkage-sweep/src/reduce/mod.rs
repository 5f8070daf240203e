//! Sweeps without their rows: reducers, and the loop that feeds them.

mod best;
mod extremes;
mod front;
mod histogram;
mod rejected;
mod tuple;

use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};

use linkage_runtime::lanes::Lanes;

pub use best::{Best, Ranked};
pub use extremes::{Bounds, Extreme, Extremes};
pub use front::{Front, Unbeaten};
pub use histogram::{Bins, Histogram};
pub use rejected::{Kind, Rejected, RejectedKind, Rejections};

use crate::threads::Threads;
use crate::{Block, Chunk, Column, Place, Progress, Sweep, SweepError};

/// A summary of all rows, collected in parts.
///
/// The parts are divided among threads in no fixed order. So that the result does not depend on them, a reducer counts,
/// or compares and prefers the lowest row; it does not add numbers that are rounded. Tuples of reducers are reducers.
pub trait Reducer<M: Lanes>: Sync {
    /// A part of the summary.
    type Part: Send;
    /// The result.
    type Output;

    /// The columns that it needs.
    fn columns(&self) -> Vec<Column>;
    /// An empty part.
    ///
    /// # Errors
    /// Those of its settings.
    fn start(&self) -> Result<Self::Part, SweepError>;
    /// Adds a chunk to a part.
    fn fold(&self, part: &mut Self::Part, block: &Block<'_, M>);
    /// Adds a part to another.
    fn merge(&self, part: &mut Self::Part, other: Self::Part);
    /// The result of all rows.
    fn finish(&self, part: Self::Part) -> Self::Output;
}

/// The state that all threads share.
struct Shared<P, F> {
    /// The number of the next chunk.
    next: u64,
    progress: Progress,
    callback: F,
    part: Option<P>,
    error: Option<SweepError>,
}

impl<P, F> Shared<P, F> {
    /// Takes the number of a chunk; none if all are taken or the sweep has ended early.
    fn take(&mut self) -> Option<u64> {
        let number = (self.error.is_none() && self.next < self.progress.chunks).then_some(self.next)?;
        self.next += 1;
        Some(number)
    }
}

impl<M: Lanes> Sweep<M>
where
    M::Branch: Send + Sync,
{
    /// Computes all chunks on all cores and reduces them. The result has the same bits for any number of threads and
    /// any number of rows per chunk.
    ///
    /// Only the columns that the reducer needs are computed; a reducer gives the same in a tuple as alone. After each chunk
    /// the callback is called, which cancels the sweep by `ControlFlow::Break(())`.
    ///
    /// # Errors
    /// Those of the reducer, [`SweepError::Cancelled`], [`Memory`](SweepError::Memory),
    /// [`Threads`](SweepError::Threads).
    pub fn reduce<R: Reducer<M>>(
        &self,
        reducer: &R,
        progress: impl FnMut(Progress) -> ControlFlow<()> + Send,
    ) -> Result<R::Output, SweepError> {
        let mut places = reducer.columns().iter().map(Column::place::<M>).collect::<Result<Vec<_>, _>>()?;
        places.sort_unstable();
        places.dedup();
        let part = Some(reducer.start()?);
        let threads = Threads::new(self.threads, self.chunks())?;
        let shared = Mutex::new(Shared { next: 0, progress: self.start(), callback: progress, part, error: None });
        threads.scope(|scope| {
            for _ in 0..threads.count_for(self.chunks()) {
                scope.spawn(|_| {
                    let _stop = StopOnPanic(&shared);
                    if let Err(error) = self.reduce_chunks(reducer, &places, &shared) {
                        lock(&shared).error.get_or_insert(error);
                    }
                });
            }
        });
        let Shared { part, error, .. } = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
        match (error, part) {
            (Some(error), _) => Err(error),
            (None, Some(part)) => Ok(reducer.finish(part)),
            (None, None) => Ok(reducer.finish(reducer.start()?)),
        }
    }

    /// The work of one thread.
    fn reduce_chunks<R: Reducer<M>, F: FnMut(Progress) -> ControlFlow<()>>(
        &self,
        reducer: &R,
        places: &[Place],
        shared: &Mutex<Shared<R::Part, F>>,
    ) -> Result<(), SweepError> {
        let mut chunk = Chunk::new(places);
        let mut part = reducer.start()?;
        let mut next = lock(shared).take();
        while let Some(number) = next {
            self.compute(number, &mut chunk)?;
            reducer.fold(&mut part, &self.block(&chunk));
            let mut shared = lock(shared);
            let Shared { progress, callback, error: error @ None, .. } = &mut *shared else { return Ok(()) };
            // Before another thread goes on: a sweep that is cancelled calls back no more.
            *error = progress.advance(chunk.rows(), chunk.rejected(), callback).err();
            next = shared.take();
        }
        let mut shared = lock(shared);
        let merged = match shared.part.take() {
            Some(mut all) => {
                reducer.merge(&mut all, part);
                all
            }
            None => part,
        };
        shared.part = Some(merged);
        Ok(())
    }
}

/// Ends the work of all threads when one panics; the scope passes the panic on.
struct StopOnPanic<'a, P, F>(&'a Mutex<Shared<P, F>>);

impl<P, F> Drop for StopOnPanic<'_, P, F> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let mut shared = lock(self.0);
            shared.next = shared.progress.chunks;
        }
    }
}

fn lock<P, F>(shared: &Mutex<Shared<P, F>>) -> MutexGuard<'_, Shared<P, F>> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
