//! The Pareto front: that of a plain search, the same bits for any number of threads and any size of chunks.

use crate::common::{go_on, sweep};
use linkage_sweep::{Case, Column, Front, Sweep, SweepError, Unbeaten, found, given};

type Crank = crate::common::Crank<f64>;

/// A long stroke, a short rod and a small offset; none if the crank does not turn fully.
fn scores(case: &Case<'_, f64, 3>) -> Option<[f64; 3]> {
    let [s, l, e] = case.columns;
    let most = s.iter().copied().fold(f64::MIN, f64::max);
    let least = s.iter().copied().fold(f64::MAX, f64::min);
    case.accepted.iter().all(|accepted| *accepted).then(|| [most - least, -l[0], -e[0].abs()])
}

fn columns() -> [Column; 3] {
    [found("s"), given("l"), given("e")]
}

fn cases() -> Sweep<Crank> {
    sweep::<f64>().with_case(1).unwrap()
}

/// The first case of each kind of scores that no other scores beat, by comparing each case with each other.
fn searched() -> Vec<Unbeaten<3>> {
    let sweep = cases().with_rows_per_chunk(usize::MAX).unwrap();
    let chunk = sweep.chunk(0, &columns()).unwrap();
    let [s, l, e] = [0, 1, 2].map(|index| chunk.columns().nth(index).unwrap().2);
    let all: Vec<Unbeaten<3>> = (0..chunk.rows() / 24)
        .filter_map(|number| {
            let rows = number * 24..(number + 1) * 24;
            let columns = [&s[rows.clone()], &l[rows.clone()], &e[rows.clone()]];
            let (case, first_row) = (number as u64, rows.start as u64);
            let accepted = &chunk.accepted()[rows];
            let scores = scores(&Case { number: case, first_row, columns, accepted })?;
            Some(Unbeaten { scores, case, first_row })
        })
        .collect();
    let is_beaten = |own: &Unbeaten<3>| {
        all.iter().any(|other| {
            let pairs = || other.scores.iter().zip(&own.scores);
            pairs().all(|(other, own)| other >= own) && pairs().any(|(other, own)| other > own)
        })
    };
    let mut front: Vec<Unbeaten<3>> = all.iter().filter(|case| !is_beaten(case)).copied().collect();
    assert!(front.len() > 5 && front.len() + 5 < all.len(), "{} of {}", front.len(), all.len());
    front.sort_by(|a, b| b.scores.partial_cmp(&a.scores).unwrap());
    front
}

#[test]
fn the_front_is_that_of_a_search() {
    let expected = searched();
    for threads in [1, 2, 5] {
        for rows in [1, 24, 100, 3000] {
            let sweep = cases().with_threads(threads).unwrap().with_rows_per_chunk(rows).unwrap();
            let front = sweep.reduce(&Front::new(columns(), scores), go_on).unwrap();
            assert_eq!(front, expected, "{threads} threads, {rows} rows per chunk");
        }
    }
}

#[test]
fn of_equal_cases_the_first_remains_and_nan_is_not_ranked() {
    for threads in [1, 3] {
        let sweep = cases().with_rows_per_chunk(1).unwrap().with_threads(threads).unwrap();
        let scores = |case: &Case<'_, f64, 0>| match case.number % 4 {
            0 => Some([f64::NAN, 9.0]),
            1 => Some(if case.number == 1 { [-0.0, 1.0] } else { [0.0, 1.0] }),
            2 => Some([1.0, 0.0]),
            _ => None,
        };
        let front = sweep.reduce(&Front::new([], scores), go_on).unwrap();
        assert_eq!(front.iter().map(|case| case.case).collect::<Vec<_>>(), [2, 1]);
        assert_eq!(front[1].scores[0].to_bits(), 0);
    }
}

#[test]
fn an_unknown_column_is_an_error() {
    let scores = |_: &Case<'_, f64, 1>| Some([0.0]);
    let result = cases().reduce(&Front::new([found("slider")], scores), go_on);
    assert!(matches!(result, Err(SweepError::UnknownColumn { .. })), "{result:?}");
}
