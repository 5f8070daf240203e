//! Time of queries in one process and on clusters on this machine: the extremes of a found column.
//!
//! `cargo bench --bench cluster -- POSITIONS ROUNDS`. In each round all take turns; printed are medians, first of a query
//! of 500 positions, which is the cost to start one, then of all positions. The last line is the number of positions from
//! which half the time of one process is more than a cluster costs to start: fewer do not pay for a second machine.

#[allow(dead_code, reason = "the tests call the other functions")]
#[path = "../tests/cluster/processes.rs"]
mod processes;

use std::io::{Error, ErrorKind, Write};
use std::time::{Duration, Instant};

use datafusion::physical_plan::common::collect;
use datafusion::prelude::SessionContext;
use linkage_engine::cluster::Cluster;
use linkage_engine::{Mechanisms, Request, session};
use linkage_sweep::Plan;
use processes::{Process, until};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The positions of a turn.
const TURN: u64 = 500;

/// A place that answers queries.
enum Place {
    Process(SessionContext),
    Cluster { cluster: Cluster, _processes: Vec<Process> },
}

impl Place {
    /// A cluster with executors that compute a number of tasks at a time.
    fn cluster(executors: usize, tasks: usize) -> Result<Self> {
        let (executors, tasks) = (executors.to_string(), tasks.to_string());
        let scheduler = Process::start(&["scheduler", "--port", "0", "--executors", &executors]);
        until("the scheduler prints its address", || !scheduler.lines().is_empty());
        let address = scheduler.lines().remove(0);
        let executor = |_| Process::start(&["executor", "--scheduler", &address, "--tasks", &tasks]);
        let executors: Vec<Process> = (0..executors.parse()?).map(executor).collect();
        let cluster = Cluster::new(&address, Mechanisms::built_in()?)?;
        Ok(Self::Cluster { cluster, _processes: executors.into_iter().chain([scheduler]).collect() })
    }

    /// The answer as text, and the time that it takes.
    async fn answer(&self, query: &str) -> Result<(String, Duration)> {
        let start = Instant::now();
        let batches = match self {
            Self::Process(context) => {
                let (context, query) = (context.clone(), query.to_owned());
                // A task, so that it runs on the threads of the runtime and not on this one.
                tokio::spawn(async move { context.sql(&query).await?.collect().await }).await??
            }
            Self::Cluster { cluster, .. } => cluster.answer(query, |rows| async { Ok(collect(rows).await?) }).await?,
        };
        let time = start.elapsed();
        Ok((datafusion::arrow::util::pretty::pretty_format_batches(&batches)?.to_string(), time))
    }
}

fn query(positions: u64) -> Result<String> {
    let plan = Plan::new().grid("a", 30.0, 70.0, positions.div_ceil(TURN)).turn("theta2", TURN);
    let request = Request { rows_per_chunk: Some(100_000), ..plan.into() };
    Ok(format!("SELECT min(mu), max(mu) FROM sweep('four_bar', '{}')", request.to_json()?))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Writes a line, or returns the error that it cannot be written.
macro_rules! line {
    ($($text:tt)*) => { writeln!(std::io::stdout(), $($text)*)? };
}

#[tokio::main]
async fn main() -> Result<()> {
    match measured().await {
        // The reader has gone, as `head` does. The processes of the clusters have ended.
        Err(error) if error.downcast_ref().is_some_and(|error: &Error| error.kind() == ErrorKind::BrokenPipe) => Ok(()),
        measured => measured,
    }
}

async fn measured() -> Result<()> {
    let numbers: Vec<u64> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let (positions, rounds) = (numbers.first().copied().unwrap_or(20_000_000), numbers.get(1).copied().unwrap_or(5));
    let cores = std::thread::available_parallelism()?.get();
    let places = [
        ("one process", Place::Process(session(Mechanisms::built_in()?))),
        ("one executor, one task at a time", Place::cluster(1, 1)?),
        ("two executors, one task at a time", Place::cluster(2, 1)?),
        ("one executor, a task per core", Place::cluster(1, cores)?),
    ];
    let mut medians = Vec::new();
    for positions in [TURN, positions] {
        let query = query(positions)?;
        let mut times = [const { Vec::new() }; 4];
        for _ in 0..rounds {
            let mut expected = None;
            for ((_, place), times) in places.iter().zip(&mut times) {
                let (answer, time) = place.answer(&query).await?;
                if expected.get_or_insert_with(|| answer.clone()) != &answer {
                    return Err("the numbers differ".into());
                }
                times.push(time.as_secs_f64());
            }
        }
        line!("{positions} positions, {cores} cores, median of {rounds}");
        let row: Vec<f64> = times.into_iter().map(median).collect();
        for ((name, _), time) in places.iter().zip(&row) {
            line!("  {name}: {time:.3} s, {:.3e} positions/s", positions as f64 / time);
        }
        medians.push(row);
    }
    if let [start, all] = medians.as_slice() {
        let rate = positions as f64 / all[0];
        line!("a second machine pays from {:.1e} positions on", 2.0 * rate * (start[3] - start[0]));
    }
    Ok(())
}
