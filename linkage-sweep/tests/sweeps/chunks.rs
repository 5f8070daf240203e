//! Chunks: pure, complete, in order.

use crate::common::{bits, crank, go_on, plan, sweep};
use linkage_runtime::PositionError;
use linkage_runtime::lanes::Lanes;
use linkage_sweep::{Column, Place, Plan, Sweep, SweepError, found, given};

type Crank = crate::common::Crank<f64>;

/// All columns of a sweep, chunk by chunk.
fn all(sweep: &Sweep<Crank>) -> (Vec<Vec<f64>>, Vec<bool>) {
    let columns = Column::all::<Crank>();
    let (mut values, mut accepted) = (vec![Vec::new(); columns.len()], Vec::new());
    for number in 0..sweep.chunks() {
        let chunk = sweep.chunk(number, &columns).unwrap();
        assert_eq!(chunk.first_row(), accepted.len() as u64);
        values.iter_mut().zip(chunk.columns()).for_each(|(all, (_, _, part))| all.extend_from_slice(part));
        accepted.extend_from_slice(chunk.accepted());
    }
    (values, accepted)
}

#[test]
fn a_chunk_depends_on_its_number_only() {
    let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap();
    let columns = Column::all::<Crank>();
    let mut reused = sweep.chunk(sweep.chunks() - 1, &columns).unwrap();
    for number in [5, 0, 21, 3] {
        let fresh = sweep.clone().chunk(number, &columns).unwrap();
        sweep.compute(number, &mut reused).unwrap();
        assert_eq!(fresh.accepted(), reused.accepted());
        for ((_, name, values), (_, _, again)) in fresh.columns().zip(reused.columns()) {
            assert_eq!(bits(values), bits(again), "{name}");
        }
    }
}

#[test]
fn the_rows_are_the_same_for_all_sizes_of_chunks() {
    let (values, accepted) = all(&sweep());
    assert_eq!(accepted.len(), 7 * 13 * 24);
    for rows in [1, 7, 24, 100, 5000] {
        let (others, mask) = all(&sweep().with_rows_per_chunk(rows).unwrap());
        assert_eq!(accepted, mask, "{rows}");
        values.iter().zip(&others).for_each(|(a, b)| assert_eq!(bits(a), bits(b), "{rows}"));
    }
}

#[test]
fn the_last_factor_varies_fastest_and_row_returns_the_given_numbers() {
    let sweep = sweep::<f64>();
    let (values, _) = all(&sweep);
    for row in [0, 1, 23, 24, 311, 312, 2183] {
        let numbers = sweep.row(row).unwrap();
        assert!(numbers.iter().map(|(name, _)| name).eq(Crank::GIVEN));
        let expected: Vec<f64> = values.iter().take(6).map(|column| column[row as usize]).collect();
        assert_eq!(bits(&numbers.iter().map(|(_, value)| *value).collect::<Vec<_>>()), bits(&expected));
    }
    assert_eq!(sweep.row(311).unwrap()[0], ("r", 0.5));
    assert_eq!(sweep.row(2183).unwrap()[0], ("r", 1.5));
    assert_eq!(sweep.row(24 + 6).unwrap()[3], ("theta", std::f64::consts::FRAC_PI_2));
    // The rate that the plan names, and the acceleration, which it does not name.
    assert_eq!(sweep.row(0).unwrap()[4..], [("theta rate", 2.0), ("theta acceleration", 0.0)]);
    assert!(matches!(sweep.row(2184), Err(SweepError::OutOfRange { quantity: "row", number: 2184, count: 2184 })));
}

#[test]
fn columns_without_a_factor_are_those_of_the_design() {
    let sweep = Sweep::new(&crank::<f64>(), (), Plan::new().turn("theta", 4)).unwrap();
    let chunk = sweep.chunk(0, &[given("l"), found("s"), given(0)]).unwrap();
    let names: Vec<_> = chunk.columns().map(|(place, name, _)| (place, name)).collect();
    assert_eq!(names, [(Place::Given(1), "l"), (Place::Found(1), "s"), (Place::Given(0), "r")]);
    assert_eq!(chunk.column(Place::Given(1)), Some(&[3.0; 4][..]));
    assert_eq!(chunk.column(Place::Given(2)), None);
    let s = chunk.column(Place::Found(1)).unwrap();
    assert!((s[0] - (1.0 + (9.0_f64 - 0.0625).sqrt())).abs() <= 4.0 * f64::EPSILON * s[0], "{s:?}");
}

#[test]
fn a_found_number_is_nan_only_in_rejected_rows() {
    let (values, accepted) = all(&sweep());
    let rejected = accepted.iter().filter(|accepted| !**accepted).count();
    assert!((50..1500).contains(&rejected), "{rejected}");
    for column in &values[6..] {
        assert!(column.iter().zip(&accepted).all(|(value, accepted)| value.is_finite() == *accepted));
    }
    for (row, accepted) in accepted.iter().enumerate() {
        let reason = sweep::<f64>().rejection(row as u64).unwrap();
        assert_eq!(reason.is_none(), *accepted);
        assert!(reason.is_none_or(|reason| matches!(reason, PositionError::Unbuildable { .. })));
    }
}

#[test]
fn a_single_precision_sweep_has_the_rounded_numbers() {
    let (single, double) = (sweep::<f32>(), sweep::<f64>());
    for row in [0, 500, 1500] {
        let pairs = single.row(row).unwrap().into_iter().zip(double.row(row).unwrap());
        pairs.for_each(|(single, double)| assert_eq!(single, (double.0, double.1 as f32)));
    }
    let columns = [found("s")];
    let (single, double) = (single.chunk(0, &columns).unwrap(), double.chunk(0, &columns).unwrap());
    let pairs = single.columns().next().unwrap().2.iter().zip(double.columns().next().unwrap().2);
    let near = |(single, double): (&f32, &f64)| (f64::from(*single) - double).abs() < 1e-5 * double.abs();
    assert!(pairs.filter(|(_, double)| double.is_finite()).take(100).all(near));
}

#[test]
fn chunks_have_whole_cases() {
    let sweep = sweep::<f64>().with_case(1).unwrap();
    assert_eq!((sweep.rows_per_case(), sweep.rows()), (24, 2184));
    assert_eq!(sweep.clone().with_rows_per_chunk(25).unwrap().rows_per_chunk(), 48);
    let whole = sweep.clone().with_case(3).unwrap().with_rows_per_chunk(1).unwrap();
    assert_eq!((whole.rows_per_chunk(), whole.chunks()), (2184, 1));
    assert_eq!(sweep.clone().with_rows_per_chunk(usize::MAX).unwrap().rows_per_chunk(), 2184);
    // All 13 columns, and the mask.
    let large = Sweep::new(&crank::<f64>(), (), Plan::new().turn("theta", 1 << 40)).unwrap();
    assert!(large.rows_per_chunk() * (13 * 8 + 1) <= 1 << 18 && large.rows_per_chunk().is_multiple_of(16));
}

#[test]
fn chunks_are_handed_over_in_order() {
    for threads in [1, 2, 3] {
        let sweep = sweep::<f64>().with_rows_per_chunk(50).unwrap().with_threads(threads).unwrap();
        let mut numbers = Vec::new();
        let mut s = Vec::new();
        let mut rows = 0;
        let progress = |progress: linkage_sweep::Progress| {
            rows = progress.rows_done;
            go_on(progress)
        };
        let take = |chunk: &linkage_sweep::Chunk<Crank>| {
            numbers.push(chunk.number());
            s.extend_from_slice(chunk.columns().next().unwrap().2);
            Ok::<(), SweepError>(())
        };
        sweep.for_each_chunk(&[found("s")], progress, take).unwrap();
        assert!(numbers.iter().copied().eq(0..sweep.chunks()));
        assert_eq!(bits(&s), bits(&all(&sweep).0[7]));
        assert_eq!(rows, 2184);
    }
}

#[test]
fn an_error_of_the_taker_ends_the_sweep() {
    let sweep = Sweep::new(&crank::<f64>(), (), plan()).unwrap().with_rows_per_chunk(10).unwrap();
    let mut taken = 0;
    let result = sweep.for_each_chunk(&[], go_on, |chunk| {
        taken += 1;
        if chunk.number() == 7 { Err(SweepError::EmptyPlan) } else { Ok(()) }
    });
    assert!(matches!(result, Err(SweepError::EmptyPlan)));
    assert_eq!(taken, 8);
}
