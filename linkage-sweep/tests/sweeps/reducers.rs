//! Reducers: the same bits for any number of threads and any size of chunks, and equal to plain loops.

use std::ops::ControlFlow;

use crate::common::{bits, go_on, sweep};
use linkage_rounding::Rounded;
use linkage_sweep::{Best, Case, Column, Extremes, Histogram, Kind, Ranked, Rejected, Sweep, SweepError, found, given};

type Crank = crate::common::Crank<f64>;

/// The largest distance of the slider relative to the rod; none if the crank does not turn fully.
fn stroke(case: &Case<'_, f64, 2>) -> Option<f64> {
    let [s, l] = case.columns;
    let most = s.iter().copied().fold(f64::MIN, f64::max);
    case.accepted.iter().all(|accepted| *accepted).then_some(most / l[0])
}

/// All results as text with all digits.
fn summary(sweep: &Sweep<Crank>) -> String {
    let reducers = (
        Rejected,
        Extremes::of(found("s rate")),
        vec![Histogram::of(found("s"), 0.0, 3.0, 17), Histogram::of(given("e"), -0.1, 0.5, 3)],
        Best::new(5, [found("s"), given("l")], stroke),
    );
    format!("{:?}", sweep.reduce(&reducers, go_on).unwrap())
}

/// The values are counted, whatever their bounds.
#[test]
fn a_histogram_of_numbers_with_bounds() {
    let histogram = || Histogram::of(found("s"), 0.0, 3.0, 17);
    let plain = sweep::<f64>().reduce(&histogram(), go_on).unwrap();
    let bounded = sweep::<Rounded>().reduce(&histogram(), go_on).unwrap();
    assert!(plain.counts.iter().sum::<u64>() > 1000, "{plain:?}");
    assert_eq!(bounded, plain);
}

/// A column of all rows, with their mask.
fn column(sweep: &Sweep<Crank>, column: Column) -> (Vec<f64>, Vec<bool>) {
    let sweep = sweep.clone().with_rows_per_chunk(usize::MAX).unwrap();
    let chunk = sweep.chunk(0, &[column]).unwrap();
    (chunk.columns().next().unwrap().2.to_vec(), chunk.accepted().to_vec())
}

#[test]
fn results_do_not_depend_on_threads_and_chunks() {
    let sweep = sweep::<f64>().with_case(1).unwrap();
    let expected = summary(&sweep);
    for threads in [1, 2, 5] {
        for rows in [1, 25, 100, 500, 3000] {
            let sweep = sweep.clone().with_threads(threads).unwrap().with_rows_per_chunk(rows).unwrap();
            assert_eq!(summary(&sweep), expected, "{threads} threads, {rows} rows per chunk");
        }
    }
}

#[test]
fn rejected_rows_are_counted_by_kind() {
    let sweep = sweep::<f64>();
    let (_, accepted) = column(&sweep, found("s"));
    let result = sweep.reduce(&Rejected, go_on).unwrap();
    let count = accepted.iter().filter(|accepted| !**accepted).count() as u64;
    let first_row = accepted.iter().position(|accepted| !accepted).unwrap() as u64;
    assert_eq!((result.total(), result.count(Kind::Unbuildable), result.count(Kind::Singular)), (count, count, 0));
    assert_eq!(result.kinds[0].first_row, first_row);
    assert_eq!(result.kinds[0].error, sweep.rejection(first_row).unwrap());
    assert_eq!(result.kinds[0].kind.to_string(), "cannot be assembled");
}

#[test]
fn extremes_are_those_of_a_loop_in_the_first_row() {
    let sweep = sweep::<f64>();
    let (values, accepted) = column(&sweep, found("s"));
    let rows: Vec<_> = values.iter().zip(accepted).enumerate().filter(|(_, (_, accepted))| *accepted).collect();
    let result = sweep.reduce(&Extremes::of(found("s")), go_on).unwrap();
    let least = rows.iter().min_by(|a, b| a.1.0.total_cmp(b.1.0)).unwrap();
    // Of equal numbers this returns the last.
    let most = rows.iter().rev().max_by(|a, b| a.1.0.total_cmp(b.1.0)).unwrap();
    let (found_least, found_most) = (result.least.unwrap(), result.most.unwrap());
    assert_eq!((found_least.row, bits(&[found_least.value])), (least.0 as u64, bits(&[*least.1.0])));
    assert_eq!((found_most.row, bits(&[found_most.value])), (most.0 as u64, bits(&[*most.1.0])));
    // A column with the same number in many rows.
    let angles = sweep.with_rows_per_chunk(5).unwrap().reduce(&Extremes::of(given("theta rate")), go_on).unwrap();
    let first = rows[0].0 as u64;
    assert_eq!((angles.least.unwrap().row, angles.most.unwrap().row), (first, first));
}

#[test]
fn a_histogram_counts_each_accepted_row_once() {
    let sweep = sweep::<f64>();
    let (values, accepted) = column(&sweep, found("s"));
    let rows = || values.iter().zip(&accepted).filter(|(_, accepted)| **accepted).map(|(value, _)| *value);
    let bins = sweep.reduce(&Histogram::of(found("s"), 0.7, 2.3, 16), go_on).unwrap();
    assert_eq!(bins.total(), rows().count() as u64);
    assert_eq!(bins.below, rows().filter(|value| *value < 0.7).count() as u64);
    assert_eq!(bins.above, rows().filter(|value| *value > 2.3).count() as u64);
    assert!(bins.below > 0 && bins.above > 0);
    for bin in 0..16 {
        let (from, to) = (bins.edge(bin), bins.edge(bin + 1));
        let count = rows().filter(|value| (from..to).contains(value) || (bin == 15 && *value == to)).count() as u64;
        assert_eq!(bins.counts[bin], count, "{bin}");
    }
}

#[test]
fn numbers_on_edges_belong_to_the_bin_above_and_the_end_to_the_last() {
    let plan = linkage_sweep::Plan::new().grid("theta", 0.0, 1.0, 11);
    let sweep = Sweep::new(&crate::common::crank::<f64>(), (), plan).unwrap();
    let bins = sweep.reduce(&Histogram::of(given("theta"), 0.0, 1.0, 10), go_on).unwrap();
    assert_eq!(bins.counts, [1, 1, 1, 1, 1, 1, 1, 1, 1, 2]);
}

#[test]
fn the_best_cases_are_those_of_a_sort() {
    let sweep = sweep::<f64>().with_case(1).unwrap();
    let (s, accepted) = column(&sweep, found("s"));
    let (l, _) = column(&sweep, given("l"));
    let mut expected: Vec<Ranked> = Vec::new();
    for case in 0..s.len() / 24 {
        let rows = case * 24..(case + 1) * 24;
        if accepted[rows.clone()].iter().all(|accepted| *accepted) {
            let most = s[rows.clone()].iter().copied().fold(f64::MIN, f64::max);
            expected.push(Ranked { score: most / l[rows.start], case: case as u64, first_row: rows.start as u64 });
        }
    }
    assert!(expected.len() > 20);
    expected.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.case.cmp(&b.case)));
    for count in [1, 5, expected.len(), 1000] {
        let best = sweep.reduce(&Best::new(count, [found("s"), given("l")], stroke), go_on).unwrap();
        assert_eq!(best, expected[..count.min(expected.len())]);
    }
}

#[test]
fn of_equal_scores_the_first_case_is_better_and_nan_is_not_ranked() {
    let sweep = sweep::<f64>().with_case(1).unwrap().with_rows_per_chunk(1).unwrap();
    let score = |case: &Case<'_, f64, 0>| match case.number % 3 {
        0 => Some(f64::NAN),
        1 => Some(if case.number.is_multiple_of(2) { 0.0 } else { -0.0 }),
        _ => None,
    };
    let best = sweep.reduce(&Best::new(4, [], score), go_on).unwrap();
    assert_eq!(best.iter().map(|ranked| ranked.case).collect::<Vec<_>>(), [1, 4, 7, 10]);
}

#[test]
fn progress_counts_all_rows() {
    let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap().with_threads(2).unwrap();
    let mut all = Vec::new();
    let rejected = sweep.reduce(&Rejected, |progress| {
        all.push(progress);
        ControlFlow::Continue(())
    });
    assert_eq!(all.len() as u64, sweep.chunks());
    assert!(all.iter().zip(1..).all(|(progress, number)| progress.chunks_done == number));
    let last = all[all.len() - 1];
    assert_eq!((last.rows_done, last.rows, last.rejected), (2184, 2184, rejected.unwrap().total()));
}

#[test]
fn a_cancelled_reduction_says_how_far_it_came() {
    for threads in [1, 3] {
        let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap().with_threads(threads).unwrap();
        let result = sweep.reduce(&Rejected, |progress| match progress.chunks_done {
            5 => ControlFlow::Break(()),
            more => {
                assert!(more < 5);
                ControlFlow::Continue(())
            }
        });
        assert!(matches!(result, Err(SweepError::Cancelled { rows_done: 500, rows: 2184 })), "{result:?}");
    }
}

#[test]
fn a_panic_of_a_score_or_a_callback_ends_the_sweep() {
    let plan = linkage_sweep::Plan::new().turn("theta", 1 << 50);
    let sweep = Sweep::new(&crate::common::crank::<f64>(), (), plan).unwrap().with_threads(2).unwrap();
    let score = |case: &Case<'_, f64, 0>| if case.number == 3000 { panic!("planned") } else { None };
    let run = std::panic::AssertUnwindSafe(|| sweep.reduce(&Best::new(1, [], score), go_on));
    assert!(std::panic::catch_unwind(run).is_err());
    let run = std::panic::AssertUnwindSafe(|| sweep.reduce(&Rejected, |_| panic!("planned")));
    assert!(std::panic::catch_unwind(run).is_err());
}
