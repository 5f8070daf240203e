//! Digits equal those of `linkage-sweep` alone, for all partitions, chunks and batches.

mod common;

use common::{Line, ROWS, context, digest, expected, lines, mechanisms, plan, request, rows, sweep, table};
use linkage_engine::{Family, Mechanisms, Request};
use linkage_sweep::{Case, Sweep, found, given};

#[tokio::test]
async fn positions_do_not_depend_on_partitions_chunks_and_batches() {
    let alone = expected(&sweep());
    let rejected = alone.iter().filter(|line| line.last() == Some(&Some(0))).count();
    assert!(rejected > 100 && rejected < 2000, "{rejected}");
    for (partitions, rows_per_chunk, batch) in
        [(1, None, 8192), (2, Some(100), 8192), (3, Some(7), 5), (8, Some(333), 100), (5, Some(1 << 20), 64)]
    {
        let request = Request { rows_per_chunk, ..request() };
        let context = context(mechanisms(), partitions, batch);
        let batches = rows(&context, &format!("SELECT * FROM {}", table("sweep", &request))).await.unwrap();
        assert!(batches.iter().all(|rows| rows.num_rows() <= batch));
        let lines = lines(&batches);
        assert_eq!(lines.len() as u64, ROWS);
        assert_eq!(digest(&lines), digest(&alone), "{partitions} partitions, chunks of {rows_per_chunk:?}");
    }
}

#[tokio::test]
async fn columns_come_in_the_order_of_the_query() {
    let context = context(mechanisms(), 3, 8192);
    let request = Request { rows_per_chunk: Some(100), ..request() };
    let query = format!("SELECT accepted, mu, a, theta3, theta2, row FROM {}", table("sweep", &request));
    let places = [found("mu"), given("a"), found("theta3"), given("theta2")];
    let chunk = sweep().with_rows_per_chunk(ROWS as usize).unwrap().chunk(0, &places).unwrap();
    let line = |row: usize| -> Line {
        let accepted = chunk.accepted()[row];
        let at = |place: usize| chunk.columns().nth(place).map(|(_, _, values)| values[row].to_bits());
        let found = |place| at(place).filter(|_| accepted);
        vec![Some(accepted.into()), found(0), at(1), found(2), at(3), Some(row as u64)]
    };
    let mut alone: Vec<Line> = (0..ROWS as usize).map(line).collect();
    alone.sort_unstable();
    assert_eq!(lines(&rows(&context, &query).await.unwrap()), alone);
}

#[tokio::test]
async fn cases_do_not_depend_on_partitions_and_chunks() {
    let sweep = sweep().with_case(1).unwrap().with_rows_per_chunk(ROWS as usize).unwrap();
    let places = [found("mu"), found("p_y"), given("b")];
    let chunk = sweep.chunk(0, &places).unwrap();
    let line = |case: Case<'_, f64, 3>| -> Line {
        let [mu, height, b] = case.columns;
        let accepted = case.accepted.iter().all(|accepted| *accepted);
        let top = accepted.then(|| height.iter().fold(0.0, |y: f64, p| p.max(y)).to_bits());
        let first = case.accepted[0].then(|| mu[0].to_bits());
        vec![Some(case.number), Some(case.first_row), Some(b[0].to_bits()), Some(accepted.into()), top, first]
    };
    let places = places.map(|column| column.place::<common::Rocker<f64>>().unwrap());
    let alone: Vec<Line> = sweep.block(&chunk).cases(places).map(line).collect();
    assert_eq!(alone.len(), 91);
    let nulls = alone.iter().filter(|line| line[4].is_none()).count();
    assert!(nulls > 10 && nulls < 80, "{nulls}");
    for (partitions, rows_per_chunk) in [(1, None), (2, Some(1)), (3, Some(100)), (16, Some(24))] {
        let request = Request { rows_per_chunk, ..request() };
        let context = context(mechanisms(), partitions, 8192);
        let query =
            format!("SELECT case_number, first_row, b, accepted, highest, start_mu FROM {}", table("cases", &request));
        assert_eq!(lines(&rows(&context, &query).await.unwrap()), alone, "{partitions} partitions");
    }
}

#[tokio::test]
async fn a_mechanism_of_single_precision_keeps_its_bits() {
    let branch = common::left();
    let mut mechanisms = Mechanisms::default();
    let design = common::Rocker { a: 40.0_f32, b: 120.0, c: 80.0, d: 100.0 };
    mechanisms.register("rocker", Family::new(design.clone(), branch)).unwrap();
    let context = context(mechanisms, 2, 8192);
    let query = format!("SELECT row, c, mu FROM {} WHERE accepted", table("sweep", &request()));
    let sweep = Sweep::new(&design, branch, plan()).unwrap();
    let chunk = sweep.with_rows_per_chunk(ROWS as usize).unwrap().chunk(0, &[given("c"), found("mu")]).unwrap();
    let columns: Vec<&[f32]> = chunk.columns().map(|(_, _, values)| values).collect();
    let bits = |column: usize, row: usize| Some(u64::from(columns[column][row].to_bits()));
    let accepted = (0..ROWS as usize).filter(|&row| chunk.accepted()[row]);
    let alone: Vec<Line> = accepted.map(|row| vec![Some(row as u64), bits(0, row), bits(1, row)]).collect();
    assert_eq!(lines(&rows(&context, &query).await.unwrap()), alone);
}

#[tokio::test]
async fn a_request_chooses_a_branch_and_numbers_cases() {
    let context = context(mechanisms(), 2, 8192);
    let of = |branch: Option<&str>| {
        let branch = branch.map(str::to_owned);
        table("sweep", &Request { branch, case_factors: Some(2), ..request() })
    };
    let mirrored = format!(
        "SELECT count(*) FROM {} AS l JOIN {} AS r ON l.row = r.row WHERE sin(l.mu) * sin(r.mu) < 0",
        of(None),
        of(Some("right"))
    );
    let accepted = format!("SELECT count(*) FROM {} WHERE accepted", of(None));
    assert_eq!(common::number(&context, &mirrored).await, common::number(&context, &accepted).await);
    // The last two factors have 13 * 24 rows.
    let wrong = format!("SELECT count(*) FROM {} WHERE case_number <> CAST(row AS BIGINT) / 312", of(None));
    assert_eq!(common::number(&context, &wrong).await, 0);
    let cases = format!("SELECT count(DISTINCT case_number) FROM {}", of(None));
    assert_eq!(common::number(&context, &cases).await, 7);
}
