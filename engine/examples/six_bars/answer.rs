//! The answer to a query, from this process or a cluster.

use std::error::Error;
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use datafusion::arrow::array::RecordBatch;
use datafusion::physical_plan::{collect, common};
use linkage_engine::cluster::{Cluster, ClusterProgress};
use linkage_engine::{Mechanisms, ScanProgress, progress, session};

use crate::query::{self, Row};

/// Answers the query on the cluster of a scheduler, or in this process.
pub async fn rows(query: &str, scheduler: Option<String>) -> Result<Vec<Row>, Box<dyn Error>> {
    let batches = match scheduler {
        Some(scheduler) => {
            let start = Instant::now();
            let print = move |ClusterProgress { partitions_done, partitions }| {
                print(partitions_done as u64, partitions as u64, "partitions", start.elapsed());
            };
            let cluster = Cluster::new(scheduler, Mechanisms::built_in()?)?;
            let cluster = cluster.with_progress(Duration::from_secs(1), print);
            cluster.answer(query, async |rows| Ok(common::collect(rows).await?)).await?
        }
        None => here(query).await?,
    };
    let rows: Option<Vec<Vec<Row>>> = batches.iter().map(query::rows).collect();
    Ok(rows.ok_or("the answer has other columns than the query")?.concat())
}

/// Answers the query in this process, and prints its progress each second.
async fn here(query: &str) -> Result<Vec<RecordBatch>, Box<dyn Error>> {
    let context = session(Mechanisms::built_in()?);
    let plan = context.sql(query).await?.create_physical_plan().await?;
    let (done, is_done) = mpsc::channel::<()>();
    let watched = Arc::clone(&plan);
    // A thread: the timers of the runtime wait while all its threads compute.
    let watch = thread::spawn(move || {
        let start = Instant::now();
        while is_done.recv_timeout(Duration::from_secs(1)) == Err(RecvTimeoutError::Timeout) {
            let ScanProgress { chunks_done, chunks } = progress(&watched);
            print(chunks_done, chunks, "chunks", start.elapsed());
        }
    });
    let batches = collect(plan, context.task_ctx()).await;
    drop(done);
    // It has nothing that panics.
    let _ = watch.join();
    Ok(batches?)
}

/// Prints the progress to the standard error, on a terminal always on one line.
fn print(done: u64, all: u64, parts: &str, time: Duration) {
    let rest = match done {
        0 => String::new(),
        done => format!(", {:.0} s to go", time.as_secs_f64() * (all as f64 / done as f64 - 1.0)),
    };
    let text = format!("{done} of {all} {parts}{rest}");
    // The stream may have lost its reader.
    let _ = match std::io::stderr().is_terminal() {
        true => write!(std::io::stderr(), "\r{text}    "),
        false => writeln!(std::io::stderr(), "{text}"),
    };
}
