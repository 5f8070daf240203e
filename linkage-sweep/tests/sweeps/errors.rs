//! Each invalid input is an error of its own, with a message that says what is wrong.

use crate::common::{Crank, crank, go_on, sweep};
use linkage_sweep::{
    Best, Column, Distribution, Extremes, Factor, Histogram, Plan, Reducer, Sequence, Sweep, SweepError, found, given,
};

fn error<T: linkage_runtime::Real>(plan: Plan) -> SweepError {
    Sweep::<Crank<T>>::new(&crank(), (), plan).unwrap_err()
}

/// The message of a plan's error.
fn message(plan: Plan) -> String {
    error::<f64>(plan).to_string()
}

fn turn() -> Plan {
    Plan::new().turn("theta", 4)
}

fn sample(column: &str, distribution: Distribution) -> Plan {
    turn().sample([(column, distribution)], 3, Sequence::Random)
}

#[test]
fn plans_without_rows() {
    assert!(matches!(error::<f64>(Plan::new()), SweepError::EmptyPlan));
    assert!(matches!(error::<f64>(Plan::new().constant("theta", 1.0)), SweepError::EmptyPlan));
    let nothing = turn().with(Factor::Sample { columns: vec![], count: 3, sequence: Sequence::Random });
    assert!(matches!(error::<f64>(nothing), SweepError::EmptySample));
    assert_eq!(message(Plan::new().turn("theta", 0)), "the number of rows of theta is 0: it must be at least 1");
    assert_eq!(message(turn().grid("r", 1.0, 2.0, 0)), "the number of rows of r is 0: it must be at least 1");
    let none = [("l", Distribution::Uniform { from: 1.0, to: 2.0 })];
    assert!(matches!(error::<f64>(turn().sample(none, 0, Sequence::QuasiRandom)), SweepError::Zero { .. }));
}

#[test]
fn plans_with_too_many_rows() {
    let plan = |count| Plan::new().grid("r", 1.0, 2.0, 1 << 32).turn("theta", count);
    assert!(matches!(error::<f64>(plan(1 << 32)), SweepError::TooManyRows));
    let most = Sweep::new(&crank::<f64>(), (), plan((1 << 32) - 1)).unwrap();
    assert_eq!(most.rows(), u64::MAX - u64::from(u32::MAX));
    let last = most.chunk(most.chunks() - 1, &[given("theta")]).unwrap();
    assert_eq!(last.first_row() + last.rows() as u64, most.rows());
}

#[test]
fn names() {
    assert!(
        matches!(error::<f64>(turn().grid("theta", 0.0, 1.0, 2)), SweepError::Twice { column } if column == "theta")
    );
    assert!(matches!(error::<f64>(turn().constant("r", 1.0).constant("r", 1.0)), SweepError::Twice { .. }));
    let twice = [("r", Distribution::Uniform { from: 1.0, to: 2.0 }); 2];
    assert!(matches!(error::<f64>(turn().sample(twice, 2, Sequence::Random)), SweepError::Twice { .. }));
    let unknown = message(Plan::new().turn("thata", 3));
    assert_eq!(unknown, "Crank has no given column thata, did you mean theta?");
    assert_eq!(message(turn().constant("nothing like it", 3.0)), "Crank has no given column nothing like it");
    let missing = message(Plan::new().grid("r", 0.5, 1.0, 3));
    assert_eq!(missing, "the plan does not name theta, an input of Crank");
}

#[test]
fn numbers_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let is_bad = |plan| matches!(error::<f64>(plan), SweepError::NotFinite { .. });
        assert!(is_bad(turn().grid("r", bad, 1.0, 2)) && is_bad(turn().grid("r", 1.0, bad, 2)));
        assert!(is_bad(turn().constant("r", bad)));
        assert!(is_bad(sample("r", Distribution::Uniform { from: bad, to: 1.0 })));
        assert!(is_bad(sample("r", Distribution::Uniform { from: 1.0, to: bad })));
        assert!(is_bad(sample("r", Distribution::Normal { mean: bad, deviation: 1.0 })));
        assert!(is_bad(sample("r", Distribution::Normal { mean: 1.0, deviation: bad })));
    }
    // The difference of the ends overflows.
    assert!(matches!(error::<f64>(turn().grid("r", f64::MIN, f64::MAX, 2)), SweepError::NotFinite { .. }));
    let wide = Distribution::Normal { mean: 0.0, deviation: 1e308 };
    assert!(matches!(error::<f64>(sample("r", wide)), SweepError::NotFinite { .. }));
    // Finite, but not in single precision.
    assert!(matches!(error::<f32>(turn().constant("r", 1e39)), SweepError::NotFinite { value: 1e39, .. }));
    assert!(Sweep::<Crank<f64>>::new(&crank(), (), turn().constant("r", 1e39)).is_ok());
    let negative = sample("r", Distribution::Normal { mean: 0.0, deviation: -1.0 });
    assert_eq!(message(negative), "the standard deviation of r is -1.0: it must be at least 0");
}

#[test]
fn settings_of_a_sweep() {
    let is_zero = |result: Result<_, SweepError>| matches!(result, Err(SweepError::Zero { column: None, .. }));
    assert!(is_zero(sweep::<f64>().with_rows_per_chunk(0)) && is_zero(sweep::<f64>().with_threads(0)));
    assert!(matches!(sweep::<f64>().with_case(4), Err(SweepError::TooManyFactors { factors: 4, most: 3 })));
    // A case that no memory holds.
    let huge =
        Sweep::<Crank<f64>>::new(&crank(), (), Plan::new().turn("theta", 1 << 60)).unwrap().with_case(1).unwrap();
    assert!(matches!(huge.chunk(0, &[]), Err(SweepError::Memory { .. })));
    assert!(matches!(huge.reduce(&Extremes::of(found("s")), go_on), Err(SweepError::Memory { .. })));
    assert!(matches!(huge.for_each_chunk(&[], go_on, |_| Ok(())), Err(SweepError::Memory { .. })));
}

#[test]
fn chunks_and_their_columns() {
    let sweep = sweep::<f64>().with_rows_per_chunk(100).unwrap();
    let error = |columns: &[Column]| sweep.chunk(0, columns).unwrap_err();
    let message = sweep.chunk(22, &[]).unwrap_err().to_string();
    assert_eq!(message, "the sweep has no chunk 22: it has 22, counted from 0");
    assert!(matches!(sweep.chunk(u64::MAX, &[]), Err(SweepError::OutOfRange { quantity: "chunk", .. })));
    let nearest = error(&[found("s rat")]);
    assert!(matches!(nearest, SweepError::UnknownColumn { kind: "found", nearest: Some("s rate"), .. }));
    assert!(matches!(error(&[given("s")]), SweepError::UnknownColumn { kind: "given", .. }));
    assert!(matches!(error(&[given(6)]), SweepError::UnknownIndex { index: 6, count: 6, .. }));
    assert!(matches!(error(&[found(7)]), SweepError::UnknownIndex { index: 7, count: 7, .. }));
    assert!(matches!(error(&[found("s"), given("r"), found(1)]), SweepError::Twice { column } if column == "s"));
}

#[test]
fn settings_of_reducers() {
    fn error<R: Reducer<Crank<f64>>>(reducer: R) -> SweepError {
        sweep::<f64>().reduce(&(reducer,), go_on).err().unwrap()
    }
    assert!(matches!(error(Extremes::of(found("x"))), SweepError::UnknownColumn { .. }));
    assert!(matches!(error(Histogram::of(found("s"), 0.0, 1.0, 0)), SweepError::Zero { quantity: "bins", .. }));
    assert!(matches!(error(Histogram::of(found("s"), 1.0, 1.0, 5)), SweepError::EmptyRange { .. }));
    assert!(matches!(error(Histogram::of(found("s"), f64::NAN, 1.0, 5)), SweepError::NotFinite { .. }));
    assert!(matches!(error(Histogram::of(found("s"), 0.0, 1.0, usize::MAX)), SweepError::Memory { .. }));
    assert!(matches!(error(Best::new(0, [], |_| Some(1.0))), SweepError::Zero { quantity: "best cases", .. }));
    assert!(matches!(error(Best::new(1, [given("x")], |_| Some(1.0))), SweepError::UnknownColumn { .. }));
    // A user may ask for any number of cases.
    let all = Best::new(usize::MAX, [], |_| Some(1.0));
    assert_eq!(sweep::<f64>().reduce(&all, go_on).unwrap().len() as u64, sweep::<f64>().rows());
}

#[cfg(feature = "serde")]
#[test]
fn a_stored_plan_is_the_same_plan() {
    let text = serde_json::to_string(&crate::common::plan()).unwrap();
    assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), crate::common::plan());
    assert!(serde_json::from_str::<Plan>(&text.replace("seed", "sead")).is_err());
}

/// Results of reducers come back with their bits; errors of rejected rows are written only.
#[cfg(feature = "serde")]
#[test]
fn results_can_be_stored() {
    use linkage_sweep::{Bins, Bounds, Extreme, Kind, Place, Progress, Ranked, RejectedKind, Rejections, Unbeaten};
    use serde_json::{from_str, json, to_string, to_value};

    macro_rules! there_and_back {
        ($($Type:ty: $value:expr;)*) => {$(
            let text = to_string(&$value).unwrap();
            assert_eq!(from_str::<$Type>(&text).unwrap(), $value, "{text}");
        )*};
    }
    there_and_back! {
        Ranked: Ranked { score: 0.1, case: 3, first_row: 36 };
        Unbeaten<2>: Unbeaten { scores: [0.1, 1.0 / 3.0], case: 3, first_row: 36 };
        Bounds<f64>: Bounds { least: Some(Extreme { value: 0.1, row: 3 }), most: None };
        Bins: Bins { from: 0.1, to: 0.7, counts: vec![1, 2], below: 3, above: 4 };
        Progress: Progress { rows_done: 1, rows: 2, chunks_done: 3, chunks: 4, rejected: 5 };
        (Column, Place): (given("theta2"), Place::Found(3));
    }
    let scores = r#"{ "scores": [0.1], "case": 3, "first_row": 36 }"#;
    let error = from_str::<Unbeaten<2>>(scores).unwrap_err().to_string();
    assert!(error.contains("invalid length 1, expected a sequence of length 2"), "{error}");
    let kinds = vec![RejectedKind { kind: Kind::Singular, count: 2, first_row: 5, error: None }];
    let expected = json!({ "kinds": [{ "kind": "Singular", "count": 2, "first_row": 5, "error": null }] });
    assert_eq!(to_value(Rejections { kinds }).unwrap(), expected);
}
