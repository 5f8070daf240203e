//! Only the columns and rows that a query asks for are computed.

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{Cam, CamBranch, LIFTS, ROWS, context, family, lines, mechanisms, number, planned, request, rows, table};
use datafusion::arrow::datatypes::DataType;
use datafusion::physical_plan::common::collect as read;
use datafusion::physical_plan::{ExecutionPlan, collect};
use futures::StreamExt;
use linkage_engine::{Family, Mechanisms, Request, SweepScan, progress};
use linkage_sweep::{Place, Plan, Sweep, given};

/// The names of the columns that the scan of a plan computes.
fn computed(plan: &Arc<dyn ExecutionPlan>) -> Option<Vec<String>> {
    match plan.downcast_ref::<SweepScan>() {
        Some(scan) => Some(scan.schema().fields().iter().map(|field| field.name().clone()).collect()),
        None => plan.children().into_iter().find_map(computed),
    }
}

#[tokio::test]
async fn only_the_columns_asked_for_are_computed() {
    let context = context(mechanisms(), 2, 8192);
    let table = table("sweep", &request());
    for (query, columns) in [
        ("SELECT theta2, mu FROM sweep WHERE mu > 0.7", vec!["theta2", "mu"]),
        ("SELECT avg(p_y) FROM sweep", vec!["p_y"]),
        ("SELECT mu FROM sweep WHERE accepted ORDER BY row LIMIT 3", vec!["row", "mu", "accepted"]),
        ("SELECT 1 FROM sweep", vec![]),
    ] {
        let plan = planned(&context, &query.replace("sweep", &table)).await.unwrap();
        assert_eq!(computed(&plan).unwrap(), columns, "{query}");
    }
}

#[tokio::test]
async fn positions_are_computed_only_if_a_query_asks_for_them() {
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("cam", Family::new(Cam::<f64>::default(), CamBranch {})).unwrap();
    let context = context(mechanisms, 2, 8192);
    let plan = Plan::new().grid("h", 1.0, 3.0, 3).turn("phi", 100);
    let chunk = Sweep::new(&Cam::default(), CamBranch {}, plan.clone()).unwrap().chunk(0, &[given("phi")]).unwrap();
    let phi: Vec<_> = chunk.column(Place::Given(1)).unwrap().iter().map(|phi| vec![Some(phi.to_bits())]).collect();
    let table = format!("sweep('cam', '{}')", Request::from(plan).to_json().unwrap());
    LIFTS.store(0, Ordering::Relaxed);
    let mut lines = lines(&rows(&context, &format!("SELECT phi FROM {table} ORDER BY row")).await.unwrap());
    assert_eq!(LIFTS.load(Ordering::Relaxed), 0);
    lines.sort_unstable();
    let mut phi = phi;
    phi.sort_unstable();
    assert_eq!(lines, phi);
    for query in ["SELECT max(h), min(row) FROM", "SELECT count(*) FROM", "SELECT 1 FROM"] {
        rows(&context, &format!("{query} {table}")).await.unwrap();
        assert_eq!(LIFTS.load(Ordering::Relaxed), 0, "{query}");
    }
    rows(&context, &format!("SELECT max(s) FROM {table}")).await.unwrap();
    assert!(LIFTS.load(Ordering::Relaxed) >= 300);
}

#[tokio::test]
async fn only_the_case_columns_asked_for_are_computed() {
    let calls = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&calls);
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("rocker", family(move || _ = counter.fetch_add(1, Ordering::Relaxed))).unwrap();
    let context = context(mechanisms, 2, 8192);
    let table = table("cases", &request());
    for (columns, count) in
        [("count(*)", 0), ("max(highest)", 0), ("max(start_mu)", 91), ("max(start_mu), min(highest)", 182)]
    {
        rows(&context, &format!("SELECT {columns} FROM {table}")).await.unwrap();
        assert_eq!(calls.load(Ordering::Relaxed), count, "{columns}");
    }
}

#[tokio::test]
async fn rows_are_counted_without_computing_them() {
    let context = context(mechanisms(), 2, 8192);
    for (function, count) in [("sweep", ROWS), ("cases", 91)] {
        let query = format!("SELECT count(*) FROM {}", table(function, &request()));
        let plan = planned(&context, &query).await.unwrap();
        assert_eq!(computed(&plan), None);
        assert_eq!(number(&context, &query).await, count as i64);
    }
    // Rows without columns.
    let batches = rows(&context, &format!("SELECT 1 FROM {}", table("sweep", &request()))).await.unwrap();
    assert_eq!(batches.iter().map(|batch| batch.num_rows()).sum::<usize>() as u64, ROWS);
}

#[tokio::test]
async fn a_limit_stops_early() {
    let request = Request { rows_per_chunk: Some(10), ..request() };
    let all = table("sweep", &request);
    for partitions in [1, 2, 5] {
        let context = context(mechanisms(), partitions, 8192);
        // Rows 0 to 24 are in the first three of 219 chunks.
        for (query, chunks, count) in [
            (format!("SELECT row, mu FROM {all} LIMIT 25"), 3, 25),
            (format!("SELECT row, mu FROM {all} ORDER BY row LIMIT 20 OFFSET 5"), 3, 20),
            (format!("SELECT row, mu FROM {all} LIMIT 0"), 0, 0),
            (format!("SELECT row, mu FROM {all} LIMIT 5000"), 219, ROWS),
        ] {
            let plan = planned(&context, &query).await.unwrap();
            let batches = collect(Arc::clone(&plan), context.task_ctx()).await.unwrap();
            let numbers: Vec<_> = lines(&batches).into_iter().map(|line| line[0]).collect();
            let first = if query.contains("OFFSET") { 5 } else { 0 };
            assert_eq!(numbers, (first..first + count).map(Some).collect::<Vec<_>>(), "{query}");
            let progress = progress(&plan);
            assert_eq!((progress.chunks_done, progress.chunks), (chunks, chunks), "{query}");
        }
    }
}

#[tokio::test]
async fn rows_in_order_need_no_sort() {
    let context = context(mechanisms(), 3, 100);
    let request = Request { rows_per_chunk: Some(50), ..request() };
    let query = format!("SELECT row, mu FROM {} ORDER BY row", table("sweep", &request));
    let plan = planned(&context, &query).await.unwrap();
    let text = datafusion::physical_plan::displayable(plan.as_ref()).indent(false).to_string();
    assert!(text.contains("SortPreservingMergeExec") && !text.contains("SortExec:"), "{text}");
    let batches = collect(plan, context.task_ctx()).await.unwrap();
    let rows = batches.iter().flat_map(|batch| lines(std::slice::from_ref(batch))).map(|line| line[0]);
    assert!(rows.eq((0..ROWS).map(Some)));
}

#[tokio::test]
async fn a_partition_takes_the_chunks_that_no_other_has_taken() {
    let context = context(mechanisms(), 2, 8192);
    let request = Request { rows_per_chunk: Some(50), ..request() };
    let plan = planned(&context, &format!("SELECT row, mu FROM {}", table("sweep", &request))).await.unwrap();
    let expected = lines(&collect(Arc::clone(&plan), context.task_ctx()).await.unwrap());
    assert_eq!(expected.len() as u64, ROWS);
    for _ in 0..2 {
        let [mut slow, fast] = [0, 1].map(|partition| plan.execute(partition, context.task_ctx()).unwrap());
        let mut batches = vec![slow.next().await.unwrap().unwrap()];
        assert_eq!(batches[0].num_rows(), 50);
        batches.extend(read(fast).await.unwrap());
        assert_eq!(read(slow).await.unwrap(), []);
        assert_eq!(lines(&batches), expected);
    }
}

#[tokio::test]
async fn found_numbers_of_rejected_rows_are_null() {
    let context = context(mechanisms(), 2, 8192);
    let all = table("sweep", &request());
    let rejected = number(&context, &format!("SELECT count(*) FROM {all} WHERE NOT accepted")).await;
    assert!(rejected > 100);
    for column in ["mu", "theta3", "p_velocity_x"] {
        let nulls = format!("SELECT count(*) FROM {all} WHERE {column} IS NULL AND NOT accepted");
        assert_eq!(number(&context, &nulls).await, rejected);
        let numbers = format!("SELECT count(*) FROM {all} WHERE {column} IS NOT NULL AND NOT isnan({column})");
        assert_eq!(number(&context, &numbers).await, ROWS as i64 - rejected);
    }
}

#[tokio::test]
async fn names_keep_upper_and_lower_case() {
    let context = context(mechanisms(), 2, 8192);
    let batches =
        rows(&context, &format!("SELECT COUNT(*) AS Count FROM {}", table("sweep", &request()))).await.unwrap();
    let schema = batches[0].schema();
    assert_eq!((schema.field(0).name().as_str(), schema.field(0).data_type()), ("Count", &DataType::Int64));
}

#[test]
fn a_scan_without_data_is_the_scan() {
    let spec = linkage_engine::ScanSpec {
        table: linkage_engine::TableSpec {
            kind: linkage_engine::TableKind::Cases,
            mechanism: "rocker".to_owned(),
            request: Request { rows_per_chunk: Some(10), branch: Some("right".to_owned()), ..request() },
        },
        projection: vec![0, 3],
        fetch: Some(7),
        partitions: 3,
    };
    let text = serde_json::to_string(&spec).unwrap();
    let back: linkage_engine::ScanSpec = serde_json::from_str(&text).unwrap();
    assert_eq!(back, spec);
    // 24 rows make a case and a chunk.
    let scan = SweepScan::new(&mechanisms(), back).unwrap();
    assert_eq!((scan.chunks(), scan.chunks_done(), scan.spec()), (7, 0, &spec));
}
