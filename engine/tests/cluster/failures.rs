//! Chunks that fail.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::Float64Type;
use datafusion::physical_plan::common::collect;
use linkage::Elbow;
use linkage_engine::cluster::{Cluster, ClusterError, ExecutorOptions, Scheduler, SchedulerOptions, executor};
use linkage_engine::mechanisms::{FourBar, FourBarBranch};
use linkage_engine::{Family, Mechanisms};
use linkage_sweep::given;
use tokio::time::timeout;

use super::processes::PATIENCE;

/// The four-bar linkage as `fragile`: the function of the design with a = 37 panics that often. The count is of all calls
/// of that design.
fn fragile(panics: usize, calls: &Arc<AtomicUsize>) -> Mechanisms {
    let calls = Arc::clone(calls);
    let family = Family::new(FourBar::<f64>::default(), FourBarBranch::new(Elbow::Left));
    let family = family.case_column("double", [given("a")], move |case| {
        let [a] = case.columns;
        let a = *a.first()?;
        assert!(a != 37.0 || calls.fetch_add(1, Ordering::Relaxed) >= panics, "no {a}, \"please\"");
        Some(2.0 * a)
    });
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("fragile", family).expect("the first name");
    mechanisms
}

/// The answer of a cluster in this process, with executors that have these mechanisms.
async fn answer(client: Mechanisms, executors: [Mechanisms; 2]) -> Result<f64, ClusterError> {
    let options = SchedulerOptions { port: 0, executors: 2, ..SchedulerOptions::default() };
    let scheduler = Scheduler::bind(options).await?;
    let address = scheduler.address().to_string();
    tokio::spawn(scheduler.serve());
    for mechanisms in executors {
        let options = ExecutorOptions { scheduler: address.clone(), tasks: 1, ..ExecutorOptions::default() };
        tokio::spawn(executor(mechanisms, options));
    }
    // Designs with a = 30 to 49; a chunk has two.
    let query = r#"SELECT sum(double) FROM cases('fragile', '{"factors": [
        {"Grid": {"column": "a", "from": 30, "to": 49, "count": 20}}, {"Turn": {"column": "theta2", "count": 10}}
    ], "rows_per_chunk": 20}')"#;
    let cluster = Cluster::new(address, client)?.with_partitions(4).with_wait(Duration::from_secs(10));
    let batches = cluster.answer(query, |rows| async { Ok(collect(rows).await?) });
    let batches = timeout(PATIENCE, batches).await.expect("an answer in time")?;
    Ok(batches[0].column(0).as_primitive::<Float64Type>().value(0))
}

/// A chunk may fail twice.
#[tokio::test(flavor = "multi_thread")]
async fn third_attempt() {
    let calls = Arc::new(AtomicUsize::new(0));
    let mechanisms = fragile(2, &calls);
    let sum = answer(mechanisms.clone(), [mechanisms.clone(), mechanisms]).await.expect("an answer");
    assert_eq!(sum, 2.0 * (30..50).map(f64::from).sum::<f64>());
    assert_eq!(calls.load(Ordering::Relaxed), 3);
}

/// After three failures of a chunk the job fails with its number and its reason.
#[tokio::test(flavor = "multi_thread")]
async fn third_failure() {
    let calls = Arc::new(AtomicUsize::new(0));
    let mechanisms = fragile(usize::MAX, &calls);
    let error = answer(mechanisms.clone(), [mechanisms.clone(), mechanisms]).await.expect_err("no answer");
    let reason = "chunk 3 of fragile: a function panicked: no 37, \"please\"; the partition failed 3 times";
    assert!(error.to_string().ends_with(reason), "{error}");
    assert_eq!(calls.load(Ordering::Relaxed), 3);
}

/// Executors without a mechanism say which one.
#[tokio::test(flavor = "multi_thread")]
async fn unknown_mechanism() {
    let mechanisms = fragile(0, &Arc::new(AtomicUsize::new(0)));
    let error = answer(mechanisms, [Mechanisms::default(), Mechanisms::default()]).await.expect_err("no answer");
    assert!(error.to_string().contains("there is no mechanism fragile"), "{error}");
}
