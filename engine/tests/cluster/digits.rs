//! A cluster computes the digits of `linkage-sweep` alone, also when an executor is lost.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use datafusion::arrow::array::{Array, AsArray, RecordBatch};
use datafusion::arrow::datatypes::{DataType, Float64Type, UInt64Type};
use datafusion::physical_plan::common::collect;
use linkage::Elbow;
use linkage_engine::cluster::{Cluster, ClusterError, ClusterProgress};
use linkage_engine::mechanisms::{FourBar, FourBarBranch};
use linkage_engine::{Mechanisms, Request, session};
use linkage_sweep::{Plan, Sweep, found, given};
use tokio::time::timeout;

use super::processes::{PATIENCE, Processes, SILENCE, until};

/// A row: its number, the bits of its numbers, of which the found ones may be missing, and `accepted`.
type Row = (u64, [Option<u64>; 5], bool);

const COLUMNS: &str = "row, a, theta2, theta3, theta4, mu, accepted";

/// Turns of four-bar linkages, of which the last ones do not assemble everywhere.
fn plan() -> Plan {
    Plan::new().grid("a", 30.0, 80.0, 400).turn("theta2", 360)
}

fn query(columns: &str) -> String {
    let request = Request { rows_per_chunk: Some(1000), ..Request::from(plan()) };
    format!("SELECT {columns} FROM sweep('four_bar', '{}')", request.to_json().expect("finite numbers"))
}

/// The number of rows and a hash of the sorted ones.
fn hash(mut rows: Vec<Row>) -> (usize, u64) {
    rows.sort_unstable();
    let mut hasher = DefaultHasher::new();
    rows.hash(&mut hasher);
    (rows.len(), hasher.finish())
}

fn rows(batches: &[RecordBatch]) -> Vec<Row> {
    let row = |batch: &RecordBatch, row: usize| {
        let column = |index: usize| {
            let column = batch.column(index).as_primitive::<Float64Type>();
            column.is_valid(row).then(|| column.value(row).to_bits())
        };
        let number = batch.column(0).as_primitive::<UInt64Type>().value(row);
        (number, [1, 2, 3, 4, 5].map(column), batch.column(6).as_boolean().value(row))
    };
    batches.iter().flat_map(|batch| (0..batch.num_rows()).map(move |index| row(batch, index))).collect()
}

/// The rows of `linkage-sweep` alone.
fn expected() -> (usize, u64) {
    let sweep = Sweep::new(&FourBar::<f64>::default(), FourBarBranch::new(Elbow::Left), plan()).expect("a plan");
    let columns = [given("a"), given("theta2"), found("theta3"), found("theta4"), found("mu")];
    let mut rows = Vec::new();
    for number in 0..sweep.chunks() {
        let chunk = sweep.chunk(number, &columns).expect("it is computed");
        let columns: Vec<&[f64]> = chunk.columns().map(|(_, _, values)| values).collect();
        for (index, &accepted) in chunk.accepted().iter().enumerate() {
            let bits = |column: usize| (accepted || column < 2).then(|| columns[column][index].to_bits());
            rows.push((rows.len() as u64, [0, 1, 2, 3, 4].map(bits), accepted));
        }
    }
    assert!(rows.iter().any(|row| !row.2) && rows.iter().any(|row| row.2), "some rows are rejected, some are not");
    hash(rows)
}

/// The rows of a query on a cluster.
async fn answer(cluster: &Cluster, query: &str) -> Result<(usize, u64), ClusterError> {
    let batches = cluster.answer(query, |rows| async { Ok(collect(rows).await?) });
    let batches = timeout(PATIENCE, batches).await.expect("an answer in time")?;
    assert!(batches.iter().all(|batch| batch.column(1).data_type() == &DataType::Float64));
    Ok(hash(rows(&batches)))
}

/// A query in this process and on two executors has the rows of the sweep.
#[tokio::test(flavor = "multi_thread")]
async fn same_digits() {
    let expected = expected();
    let alone = session(Mechanisms::built_in().expect("names differ"));
    let batches = alone.sql(&query(COLUMNS)).await.expect("a plan").collect().await.expect("rows");
    assert_eq!(hash(rows(&batches)), expected, "one process");

    let processes = Processes::start(2);
    let cluster = processes.cluster();
    assert_eq!(answer(&cluster, &query(COLUMNS)).await.expect("an answer"), expected, "two executors");
    for executor in &processes.executors {
        assert!(!executor.partitions("ends").is_empty(), "both executors compute");
    }
    // Rows that meet again in other tasks.
    let grouped = format!("SELECT {COLUMNS} FROM ({}) ORDER BY mu, row", query(COLUMNS));
    assert_eq!(answer(&cluster, &grouped).await.expect("an answer"), expected, "sorted");
    let all: Vec<String> = COLUMNS.split(", ").map(|name| format!("max({name}) AS {name}")).collect();
    let grouped = format!("SELECT {} FROM ({}) GROUP BY row", all.join(", "), query(COLUMNS));
    let grouped = grouped.replace("max(accepted)", "bool_or(accepted)");
    assert_eq!(answer(&cluster, &grouped).await.expect("an answer"), expected, "grouped");
}

/// The reports of a query say how many partitions of its two scans are computed.
#[tokio::test(flavor = "multi_thread")]
async fn progress() {
    let processes = Processes::start(1);
    let reports = Arc::new(Mutex::new(Vec::new()));
    let written = Arc::clone(&reports);
    let write = move |report: ClusterProgress| written.lock().expect("no panic").push(report);
    let cluster = processes.cluster().with_progress(Duration::from_millis(50), write);
    let both = format!("{0} UNION ALL {0} ORDER BY mu", query(COLUMNS));
    assert_eq!(answer(&cluster, &both).await.expect("an answer").0, 2 * expected().0);
    let reports = reports.lock().expect("no panic");
    assert!(reports.iter().all(|report| report.partitions == 32 && report.partitions_done <= 32), "{reports:?}");
    assert!(reports.is_sorted_by_key(|report| report.partitions_done), "{reports:?}");
    assert!(reports.iter().any(|report| (1..32).contains(&report.partitions_done)), "{reports:?}");
}

/// The rows of a query during which an executor that has finished some partitions gets a signal. The other executor
/// computes all partitions.
async fn with_signal(query: &str, name: &'static str) -> (usize, u64) {
    let mut processes = Processes::start_to_lose_one(2);
    let cluster = processes.cluster();
    let query = query.to_owned();
    let answer = tokio::spawn(async move { answer(&cluster, &query).await });
    let lost = processes.executors.remove(0);
    let lost = tokio::task::spawn_blocking(move || {
        until("an executor finishes a partition", || !lost.partitions("ends").is_empty());
        lost.signal(name);
        lost
    });
    let lost = lost.await.expect("no panic");
    assert!(!answer.is_finished(), "the job runs");
    if name == "STOP" {
        // It goes on after its tasks went to the other one, and reports what it has.
        tokio::time::sleep(SILENCE + Duration::from_secs(5)).await;
        lost.signal("CONT");
    }
    let rows = answer.await.expect("no panic").expect("an answer");
    let mut partitions = processes.executors[0].partitions("ends");
    partitions.sort_unstable();
    assert_eq!(partitions, (0..16).collect::<Vec<u64>>(), "the other executor computes all partitions, each once");
    rows
}

#[tokio::test(flavor = "multi_thread")]
async fn killed() {
    assert_eq!(with_signal(&query(COLUMNS), "KILL").await, expected());
}

#[tokio::test(flavor = "multi_thread")]
async fn killed_while_sorting() {
    let sorted = format!("SELECT {COLUMNS} FROM ({}) ORDER BY mu, row", query(COLUMNS));
    assert_eq!(with_signal(&sorted, "KILL").await, expected());
}

#[tokio::test(flavor = "multi_thread")]
async fn silent() {
    assert_eq!(with_signal(&query(COLUMNS), "STOP").await, expected());
}

/// The executor with the result is killed before the result is read: the query runs again on another one.
#[tokio::test(flavor = "multi_thread")]
async fn lost_result() {
    let mut processes = Processes::start_to_lose_one(1);
    let cluster = processes.cluster();
    let only = Mutex::new(Some(processes.executors.remove(0)));
    let other = Mutex::new(None);
    let query = query(COLUMNS);
    let answer = cluster.answer(&query, |rows| async {
        if let Some(mut executor) = only.lock().expect("no panic").take() {
            executor.kill();
            *other.lock().expect("no panic") = Some(processes.executor());
        }
        Ok(collect(rows).await?)
    });
    let batches = timeout(PATIENCE, answer).await.expect("an answer in time").expect("an answer");
    assert_eq!(hash(rows(&batches)), expected());
    let other = other.into_inner().expect("no panic").expect("it was started");
    assert_eq!(other.partitions("ends").len(), 16);
}

/// The only executor is killed: the job fails.
#[tokio::test(flavor = "multi_thread")]
async fn no_executor_remains() {
    let mut processes = Processes::start_to_lose_one(1);
    let cluster = processes.cluster();
    let answer = tokio::spawn(async move { answer(&cluster, &query(COLUMNS)).await });
    let mut only = processes.executors.remove(0);
    let killed = tokio::task::spawn_blocking(move || {
        until("the executor finishes a partition", || !only.partitions("ends").is_empty());
        only.kill();
    });
    killed.await.expect("no panic");
    let error = answer.await.expect("no panic").expect_err("no answer").to_string();
    assert!(error.contains(&processes.address) && error.contains("executor"), "{error}");
}
