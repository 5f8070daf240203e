//! Record batches: the schema, the bits, nulls, order, cancellation.

mod common;

use std::ops::ControlFlow;

use common::{FourBar, ROWS, columns, compare, go_on, sweep};
use linkage::linkage;
use linkage_sweep::{Column, Plan, Sweep, SweepError, found, given};
use linkage_sweep_arrow::arrow_array::RecordBatch;
use linkage_sweep_arrow::arrow_array::cast::AsArray;
use linkage_sweep_arrow::arrow_array::types::Float64Type;
use linkage_sweep_arrow::arrow_schema::{ArrowError, DataType};
use linkage_sweep_arrow::{Error, MECHANISM, SEED, for_each_record_batch, record_batch, schema};

#[test]
fn a_schema_has_names_types_and_the_origin() {
    let wide = schema(&sweep::<f64>(), &columns()).unwrap();
    let narrow = schema(&sweep::<f32>(), &columns()).unwrap();
    for (schema, number) in [(wide, DataType::Float64), (narrow, DataType::Float32)] {
        let fields: Vec<_> = schema
            .fields()
            .iter()
            .map(|field| (field.name().as_str(), field.data_type(), field.is_nullable()))
            .collect();
        let expected = [
            ("theta2", &number, false),
            ("theta4", &number, true),
            ("a", &number, false),
            ("d", &number, false),
            ("lift", &number, true),
            ("mu", &number, true),
            ("accepted", &DataType::Boolean, false),
        ];
        assert_eq!(fields, expected);
        assert_eq!(schema.metadata().len(), 2);
        assert_eq!(schema.metadata()[MECHANISM], "FourBar");
        assert_eq!(schema.metadata()[SEED], "42");
    }
}

#[test]
fn all_columns_have_different_names() {
    let all = Column::all::<FourBar<f64>>();
    let schema = schema(&sweep::<f64>(), &all).unwrap();
    let mut names: Vec<_> = schema.fields().iter().map(|field| field.name()).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), all.len() + 1);
    let chunk = sweep::<f64>().chunk(3, &all).unwrap();
    assert_eq!(record_batch(&schema, &chunk).unwrap().num_columns(), all.len() + 1);
}

linkage! {
    /// Kepler's equation, which has no closed form: the guess of psi is given, and psi is found.
    mechanism Kepler {
        param e = 0.5;
        input theta;
        unknown psi;
        equation psi - e * sin(psi) = theta;
        derive lanes;
    }
}

#[test]
fn a_given_and_a_found_column_of_one_name() {
    let plan = Plan::new().grid("theta", 0.0, 3.0, 10).constant("psi", 1.0);
    let sweep = Sweep::new(&Kepler::<f64>::default(), KeplerBranch::new(), plan).unwrap();
    let both = [given("psi"), found("psi")];
    let schema_of_both = schema(&sweep, &both).unwrap();
    let names: Vec<_> = schema_of_both.fields().iter().map(|field| field.name().as_str()).collect();
    assert_eq!(names, ["given psi", "psi", "accepted"]);
    let batch = record_batch(&schema_of_both, &sweep.chunk(0, &both).unwrap()).unwrap();
    assert_eq!(batch.column(0).as_primitive::<Float64Type>().value(3), 1.0);
    let exchanged = sweep.chunk(0, &[found("psi"), given("psi")]).unwrap();
    let error = record_batch(&schema_of_both, &exchanged).unwrap_err();
    assert!(matches!(error, Error::Schema { index: 0, column: "psi" }), "{error}");
}

#[test]
fn columns_that_do_not_exist() {
    let error = schema(&sweep::<f64>(), &[found("theta5")]).unwrap_err();
    assert!(matches!(error, Error::Sweep(SweepError::UnknownColumn { .. })), "{error}");
    let error = schema(&sweep::<f64>(), &[given("a"), given("a")]).unwrap_err();
    assert!(matches!(error, Error::Sweep(SweepError::Twice { .. })), "{error}");
}

#[test]
fn batches_have_the_bits_of_chunks() {
    fn check<T: common::Bits>() {
        for threads in [1, 2] {
            let sweep = sweep::<T>().with_threads(threads).unwrap();
            let mut batches = Vec::new();
            let take = |batch: RecordBatch| {
                batches.push(batch);
                Ok::<(), Error>(())
            };
            for_each_record_batch(&sweep, &columns(), go_on, take).unwrap();
            assert_eq!(batches.len(), ROWS.div_ceil(100));
            // Only the output of limited domain is missing in accepted rows.
            let missing = compare(&batches, &sweep, &columns());
            assert!(missing > 100, "{missing}");
            let others = [found("theta4"), given("a"), found("mu")];
            let mut batches = Vec::new();
            let take = |batch: RecordBatch| {
                batches.push(batch);
                Ok::<(), Error>(())
            };
            for_each_record_batch(&sweep, &others, go_on, take).unwrap();
            assert_eq!(compare(&batches, &sweep, &others), 0);
        }
    }
    check::<f64>();
    check::<f32>();
}

#[test]
fn no_columns_give_the_mask() {
    let chunk = sweep::<f64>().chunk(21, &[]).unwrap();
    let batch = record_batch(&schema(&sweep::<f64>(), &[]).unwrap(), &chunk).unwrap();
    assert_eq!((batch.num_columns(), batch.num_rows()), (1, 84));
}

#[test]
fn the_schema_of_other_columns_is_an_error() {
    let chunk = sweep::<f64>().chunk(0, &[given("theta2"), found("mu")]).unwrap();
    let batch = |columns: &[Column]| record_batch(&schema(&sweep::<f64>(), columns).unwrap(), &chunk);
    batch(&[given("theta2"), found("mu")]).unwrap();
    for other in [&[given("theta2"), found("theta4")][..], &[given("theta2")], &[given("theta2"), given("a")]] {
        let error = batch(other).unwrap_err();
        assert!(matches!(error, Error::Schema { index: 1, column: "mu" }), "{error}");
    }
    // One column more, and another scalar.
    let error = batch(&[given("theta2"), found("mu"), found("theta4")]).unwrap_err();
    assert!(matches!(error, Error::Arrow(ArrowError::InvalidArgumentError(_))), "{error}");
    let narrow = schema(&sweep::<f32>(), &[given("theta2"), found("mu")]).unwrap();
    let error = record_batch(&narrow, &chunk).unwrap_err();
    assert!(matches!(error, Error::Arrow(ArrowError::InvalidArgumentError(_))), "{error}");
}

#[test]
fn a_callback_cancels() {
    let mut count = 0;
    let progress = |progress: linkage_sweep::Progress| match progress.chunks_done == 3 {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let take = |_| {
        count += 1;
        Ok::<(), Error>(())
    };
    let error = for_each_record_batch(&sweep::<f64>(), &columns(), progress, take).unwrap_err();
    assert!(matches!(error, Error::Sweep(SweepError::Cancelled { rows_done: 300, rows: 2184 })), "{error}");
    assert_eq!(count, 3);
}

#[test]
fn an_error_of_the_caller_returns() {
    #[derive(Debug)]
    enum Mine {
        Enough,
        Other,
    }
    impl From<Error> for Mine {
        fn from(_: Error) -> Self {
            Self::Other
        }
    }
    let result = for_each_record_batch(&sweep::<f64>(), &columns(), go_on, |_| Err(Mine::Enough));
    assert!(matches!(result, Err(Mine::Enough)));
    let result = for_each_record_batch(&sweep::<f64>(), &[given(99)], go_on, |_| Err(Mine::Enough));
    assert!(matches!(result, Err(Mine::Other)));
}
