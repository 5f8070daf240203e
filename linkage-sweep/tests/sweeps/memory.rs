//! The memory of a sweep does not grow with its rows.

mod common;

use cap::Cap;
use common::{crank, go_on};
use linkage_sweep::{Best, Case, Column, Extremes, Histogram, Plan, Rejected, Sweep, SweepError, found};
use peak_alloc::PeakAlloc;

type Crank = common::Crank<f64>;

/// Counts all bytes; the allocator in it counts those in use.
#[global_allocator]
static MEMORY: Cap<PeakAlloc> = Cap::new(PeakAlloc, usize::MAX);

/// A sweep of chunks of 500 rows, of which some are rejected.
fn sweep(chunks: u64, threads: usize) -> Sweep<Crank> {
    let plan = Plan::new().grid("l", 0.9, 2.0, chunks).turn("theta", 500);
    let sweep = Sweep::new(&crank(), (), plan).unwrap().with_case(1).unwrap();
    sweep.with_threads(threads).unwrap().with_rows_per_chunk(1).unwrap()
}

/// The largest number of bytes in use at once while the work is done, less those before; and all bytes allocated.
fn memory(work: impl FnOnce()) -> (usize, usize) {
    PeakAlloc.reset_peak_usage();
    let (before, total) = (PeakAlloc.current_usage(), MEMORY.total_allocated());
    work();
    (PeakAlloc.peak_usage() - before, MEMORY.total_allocated() - total)
}

/// Work on a number of chunks by a number of threads.
type Work<'a> = &'a dyn Fn(u64, usize);

/// The only test of this file: others would allocate at the same time.
#[test]
fn memory_is_constant() {
    let reduce = |chunks, threads| {
        let spread = |case: &Case<'_, f64, 1>| case.columns[0].first().copied();
        let reducers = (
            Rejected,
            Extremes::of(found("s rate")),
            Histogram::of(found("s"), 0.0, 3.0, 100),
            Best::new(3, [found("s")], spread),
        );
        sweep(chunks, threads).reduce(&reducers, go_on).unwrap();
    };
    let deliver = |chunks, threads| {
        let all = Column::all::<Crank>();
        sweep(chunks, threads).for_each_chunk(&all, go_on, |_| Ok::<_, SweepError>(())).unwrap();
    };
    let write = |chunks, threads| {
        sweep(chunks, threads).write_csv_to(std::io::sink(), &[found("s")], go_on).unwrap();
    };
    // Rayon's queues free their memory late. This is 33 bytes for each chunk.
    let few = 1 << 15;
    // The first sweep of a process also allocates what remains.
    reduce(3, 2);
    let kinds: [(&str, Work); 3] = [("reduce", &reduce), ("deliver", &deliver), ("write", &write)];
    for (kind, work) in kinds {
        let (least, total) = memory(|| work(10, 1));
        for threads in [1, 2] {
            let (most, all) = memory(|| work(1000, threads));
            assert!(most <= threads * least + few, "{kind}, {threads} threads: {least} bytes, then {most}");
            if kind == "reduce" {
                assert!(all <= threads * total + few, "{kind}, {threads} threads: {total} bytes in all, then {all}");
            }
        }
    }
}
