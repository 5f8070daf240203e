//! Chunks in order.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use linkage_runtime::lanes::Lanes;

use crate::column::places;
use crate::threads::Threads;
use crate::{Chunk, Column, Progress, Sweep, SweepError};

/// A chunk that waits for its turn, and what is made of it on the thread that computes it.
struct Slot<M: Lanes, B> {
    chunk: Chunk<M>,
    buffer: B,
    result: Result<(), SweepError>,
}

impl<M: Lanes> Sweep<M>
where
    M::Branch: Send + Sync,
{
    /// Computes all chunks on all cores and hands them over in order, on the thread of the caller. Twice two chunks for
    /// each thread are in memory.
    ///
    /// After each chunk the callback `progress` is called, which cancels the sweep by `ControlFlow::Break(())`.
    ///
    /// # Errors
    /// Those of `take`, of [`chunk`](Sweep::chunk), [`SweepError::Cancelled`] and [`Threads`](SweepError::Threads).
    pub fn for_each_chunk<E: From<SweepError>>(
        &self,
        columns: &[Column],
        progress: impl FnMut(Progress) -> ControlFlow<()>,
        mut take: impl FnMut(&Chunk<M>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.deliver(columns, progress, |_, ()| Ok(()), |chunk, ()| take(chunk))
    }

    /// Computes and prepares chunks on all cores and hands them over in order.
    pub(crate) fn deliver<B: Default + Send, E: From<SweepError>>(
        &self,
        columns: &[Column],
        mut progress: impl FnMut(Progress) -> ControlFlow<()>,
        prepare: impl Fn(&Chunk<M>, &mut B) -> Result<(), SweepError> + Sync,
        mut take: impl FnMut(&Chunk<M>, &mut B) -> Result<(), E>,
    ) -> Result<(), E> {
        let places = places::<M>(columns)?;
        let chunks = self.chunks();
        let threads = Threads::new(self.threads, chunks)?;
        let window = usize::try_from(chunks).map_or(usize::MAX, |chunks| chunks.min(2 * threads.count()));
        let slot = || Slot { chunk: Chunk::new(&places), buffer: B::default(), result: Ok(()) };
        let slots = || (0..window).map(|_| slot()).collect::<Vec<_>>();
        let (mut ready, mut next) = (slots(), slots());
        let (mut done, mut count, mut number) = (self.start(), 0, 0);
        // One window is computed while that before it is handed over.
        while number < chunks || count > 0 {
            let computed = usize::try_from(chunks - number).map_or(window, |rest| rest.min(window));
            let waiting = Mutex::new((number..).zip(next.iter_mut().take(computed)));
            threads.scope(|scope| {
                for _ in 0..threads.count().min(computed) {
                    scope.spawn(|_| {
                        let take = || waiting.lock().unwrap_or_else(PoisonError::into_inner).next();
                        while let Some((number, slot)) = take() {
                            let computed = self.compute(number, &mut slot.chunk);
                            slot.result = computed.and_then(|()| prepare(&slot.chunk, &mut slot.buffer));
                        }
                    });
                }
                for Slot { chunk, buffer, result } in ready.iter_mut().take(count) {
                    std::mem::replace(result, Ok(()))?;
                    take(chunk, buffer)?;
                    done.advance(chunk.rows(), chunk.rejected(), &mut progress)?;
                }
                Ok::<(), E>(())
            })?;
            std::mem::swap(&mut ready, &mut next);
            (count, number) = (computed, number + computed as u64);
        }
        Ok(())
    }
}
