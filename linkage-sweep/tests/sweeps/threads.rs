//! A sweep starts no more threads than have something to do. This file has one test: other tests have threads too.

use std::fs;

use crate::common::{Crank, crank, go_on, plan};
use linkage_sweep::{Extremes, Plan, Rejected, Sweep, SweepError, found};

/// The threads of this process, as Linux counts them.
fn threads() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    status.lines().find_map(|line| line.strip_prefix("Threads:"))?.trim().parse().ok()
}

/// Waits until the threads of the last pool have ended.
fn settled(before: usize) {
    while threads().is_some_and(|count| count > before) {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
}

#[test]
fn any_number_of_threads_may_be_asked_for() {
    let before = threads().unwrap_or(0);
    let cores = std::thread::available_parallelism().unwrap().get();
    let reducers = (Rejected, Extremes::of(found("s")));
    let sweep = |plan: Plan| Sweep::<Crank<f64>>::new(&crank(), (), plan).unwrap().with_rows_per_chunk(100).unwrap();
    let alone = sweep(plan()).with_threads(1).unwrap().reduce(&reducers, go_on).unwrap();
    settled(before);
    for count in [2, 1000, 1 << 20, 1 << 40, usize::MAX] {
        // Three chunks, 22 chunks, and more than there can be threads.
        for (plan, most) in
            [(Plan::new().turn("theta", 300), 3), (plan(), 22), (Plan::new().turn("theta", 100_000), 1000)]
        {
            let is_all = most == 22;
            let sweep = sweep(plan).with_threads(count).unwrap();
            let mut largest = 0;
            let count_threads = |progress| {
                largest = largest.max(threads().unwrap_or(0));
                go_on(progress)
            };
            let reduced = sweep.reduce(&reducers, count_threads).unwrap();
            assert!(!is_all || reduced == alone, "{count}");
            let most = most.min(8 * cores).min(count);
            assert!(largest <= before + most, "{count}: {largest} threads, {before} before");
            settled(before);
            let mut rows = 0;
            let take = |chunk: &linkage_sweep::Chunk<Crank<f64>>| {
                rows += chunk.rows() as u64;
                largest = largest.max(threads().unwrap_or(0));
                Ok::<(), SweepError>(())
            };
            sweep.for_each_chunk(&[found("s")], go_on, take).unwrap();
            assert_eq!(rows, sweep.rows());
            assert!(largest <= before + most, "{count}: {largest} threads, {before} before");
            settled(before);
        }
    }
}
