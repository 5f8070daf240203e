//! Invalid input: each message says what is wrong and where.

mod common;

use common::{context, family, left, mechanisms, message, request, table};
use linkage_engine::{EngineError, Family, Mechanisms, Request, ScanSpec, SweepScan, TableKind, TableSpec};
use linkage_sweep::found;

#[tokio::test]
async fn arguments() {
    let context = context(mechanisms(), 2, 8192);
    for (query, expected) in [
        (
            "SELECT mu FROM sweep('rocket', '{}')",
            "sweep('rocket'): the plan is not valid: missing field `factors` at line 1 column 2",
        ),
        ("SELECT mu FROM sweep('rocket', '{\"factors\": []}')", "there is no mechanism rocket, did you mean rocker?"),
        ("SELECT mu FROM sweep('lever', '{\"factors\": []}')", "there is no mechanism lever: registered are rocker"),
        (
            "SELECT mu FROM sweep('rocker')",
            "sweep has 1 arguments: it takes the name of a mechanism and a plan in JSON",
        ),
        ("SELECT mu FROM cases()", "cases has 0 arguments: it takes the name of a mechanism and a plan in JSON"),
        (
            "SELECT mu FROM sweep(1, '{}')",
            "argument 1 of sweep is Int64(1): it must be a string, the name of a mechanism",
        ),
        ("SELECT mu FROM sweep('rocker', NULL)", "argument 2 of sweep is NULL: it must be a string, a plan in JSON"),
        ("SELECT mu FROM swap('rocker', '{}')", "Error during planning: table function 'swap' not found"),
    ] {
        assert_eq!(message(&context, query).await, expected, "{query}");
    }
}

#[tokio::test]
async fn plans() {
    let context = context(mechanisms(), 2, 8192);
    let turn = |more: &str| format!(r#"{{"factors": [{{"Turn": {{"column": "theta2", "count": 9}}}}]{more}}}"#);
    for (json, expected) in [
        (r#"{"factors": ["#.to_owned(), "the plan is not valid: EOF while parsing a list at line 1 column 13"),
        (turn(r#", "factor": 1"#), "the plan is not valid: unknown field `factor`, expected one of"),
        (
            "{\"factors\":\n [{\"Turn\": {\"colum\": 1}}]}".to_owned(),
            "the plan is not valid: unknown field `colum`, expected `column` or `count` at line 2 column 19",
        ),
        (turn(r#", "constants": [["b", 1e999]]"#), "the plan is not valid: number out of range at line 1 column"),
        (
            turn(r#", "rows_per_chunk": -1"#),
            "the plan is not valid: invalid value: integer `-1`, expected usize at line 1 column",
        ),
        (turn(r#", "rows_per_chunk": 0"#), "the number of rows per chunk is 0: it must be at least 1"),
        (turn(r#", "case_factors": 2"#), "a case of 2 factors is more than the plan, which has 1"),
        (turn(r#", "constants": [["bb", 1]]"#), "Rocker has no given column bb, did you mean b?"),
        (turn(r#", "constants": [["theta2", 1]]"#), "the column theta2 is named twice"),
        (turn(r#", "branch": "left""#), "rocker has no branch left: it has right"),
        (r#"{"factors": []}"#.to_owned(), "the plan has no factors: add a grid, a turn or a sample"),
    ] {
        let message = message(&context, &format!("SELECT mu FROM sweep('rocker', '{json}')")).await;
        assert!(message.starts_with(&format!("sweep('rocker'): {expected}")), "{message}");
        assert_eq!(message.lines().count(), 1);
    }
}

#[tokio::test]
async fn columns() {
    let context = context(mechanisms(), 2, 8192);
    let (sweep, cases) = (table("sweep", &request()), table("cases", &request()));
    for (query, expected) in [
        (format!("SELECT thteta2 FROM {sweep}"), "there is no column thteta2, did you mean theta2?"),
        (format!("SELECT MU FROM {sweep}"), "there is no column MU, did you mean mu?"),
        (format!("SELECT row FROM {sweep} WHERE force > 1"), "there is no column force"),
        (format!("SELECT heighest FROM {cases}"), "there is no column heighest, did you mean highest?"),
    ] {
        assert_eq!(message(&context, &query).await, expected);
    }
    let text = message(&context, &format!("SELECT mu FROM {sweep} WHERE mu > 'x'")).await;
    assert!(text.contains("Cannot cast string 'x'"), "{text}");
    assert!(message(&context, "SELEC").await.contains("Line: 1, Column: 1"));
}

/// DataFusion reads these and answers as if they were not there.
#[tokio::test]
async fn what_would_be_ignored_is_an_error() {
    let context = context(mechanisms(), 2, 8192);
    let all = table("sweep", &request());
    let sample = "TABLESAMPLE is not supported: write a sample of the plan, or WHERE random() < 0.1";
    let ordinality = "WITH ORDINALITY is not supported: write the column row or case_number";
    for (query, expected) in [
        ("SELECT count(*) FROM @ TABLESAMPLE (10 PERCENT)", sample),
        ("SELECT count(*) FROM @ TABLESAMPLE BERNOULLI (10)", sample),
        ("SELECT count(*) FROM @ t TABLESAMPLE SYSTEM (10) REPEATABLE (3)", sample),
        ("SELECT count(*) FROM @ TABLESAMPLE (5 ROWS)", sample),
        ("SELECT count(*) FROM (SELECT * FROM @) TABLESAMPLE (10 PERCENT)", sample),
        ("WITH t AS (SELECT * FROM @) SELECT count(*) FROM t TABLESAMPLE (5)", sample),
        ("SELECT count(*) FROM @ a JOIN @ b TABLESAMPLE (5) ON a.row = b.row", sample),
        ("SELECT 1 WHERE EXISTS (SELECT 1 FROM @ TABLESAMPLE (5))", sample),
        ("SELECT * FROM @ WITH ORDINALITY", ordinality),
    ] {
        assert_eq!(message(&context, &query.replace('@', &all)).await, expected, "{query}");
    }
    let query = format!("SELECT count(*) FROM {all} WHERE random() < 0.1");
    assert!((1..2184).contains(&common::number(&context, &query).await));
}

#[tokio::test]
async fn a_panic_of_a_function_is_an_error_of_its_chunk() {
    let family = Family::new(common::Rocker::<f64>::default(), left()).case_column("fifth", [found("mu")], |case| {
        assert!(case.number != 5, "case {} is not there", case.number);
        Some(1.0)
    });
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("rocker", family).unwrap();
    let context = context(mechanisms, 2, 8192);
    let cases = table("cases", &Request { rows_per_chunk: Some(48), ..request() });
    let text = message(&context, &format!("SELECT sum(fifth) FROM {cases}")).await;
    assert_eq!(text, "chunk 2 of rocker: a function panicked: case 5 is not there");
    // The session answers the next query.
    assert_eq!(common::number(&context, &format!("SELECT count(b) FROM {cases}")).await, 91);
}

#[test]
fn registrations() {
    let family = || family(|| ());
    let mut mechanisms = mechanisms();
    let text = |error: EngineError| error.to_string();
    assert_eq!(
        mechanisms.register("rocker", family()).map(drop).map_err(text),
        Err("the mechanism rocker is registered twice".to_owned())
    );
    let twice = family().branch("right", left());
    assert_eq!(
        mechanisms.register("a", twice).map(drop).map_err(text),
        Err("the branch right is registered twice".to_owned())
    );
    let unknown = family().case_column("force", [found("forse")], |_| None);
    assert_eq!(
        mechanisms.register("b", unknown).map(drop).map_err(text),
        Err("Rocker has no found column forse".to_owned())
    );
    for name in ["b", "accepted", "case_number", "highest"] {
        let taken = family().case_column(name, [], |_| None);
        let expected = Err(format!("the column {name} is registered twice"));
        assert_eq!(mechanisms.register("c", taken).map(drop).map_err(text), expected);
    }
    assert_eq!(mechanisms.names().collect::<Vec<_>>(), ["rocker"]);
}

#[test]
fn scans_of_other_processes() {
    let spec = |mechanism: &str, column| ScanSpec {
        table: TableSpec { kind: TableKind::Sweep, mechanism: mechanism.to_owned(), request: request() },
        projection: vec![0, column],
        fetch: None,
        partitions: 2,
    };
    let message = |spec| SweepScan::new(&mechanisms(), spec).unwrap_err().to_string();
    assert_eq!(message(spec("lever", 1)), "there is no mechanism lever: registered are rocker");
    assert_eq!(message(spec("rocker", 99)), "there is no column of index 99: there are 28");
}
