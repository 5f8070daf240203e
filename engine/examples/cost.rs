//! Time and memory of queries: the extremes of one found column, by `linkage-sweep` alone and by SQL.
//!
//! Run it with `--release`. `cost overhead ROUNDS` takes a million positions, in chunks of 100 000, on one thread and on
//! all; rounds of both take turns, and the median is that of the ratio within a round. `cost memory POSITIONS` answers
//! one query of that many positions, and prints the largest memory at a tenth of the chunks and at the end.

use std::error::Error;
use std::fs;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use datafusion::arrow::array::{AsArray, RecordBatch};
use datafusion::arrow::datatypes::Float64Type;
use datafusion::physical_plan::collect;
use datafusion::prelude::SessionContext;
use linkage::Elbow;
use linkage_engine::mechanisms::{FourBar, FourBarBranch};
use linkage_engine::{Mechanisms, Request, progress, register, session};
use linkage_sweep::{Extremes, Plan, Sweep, found};

const ROWS_PER_CHUNK: usize = 100_000;
/// The rows of a turn.
const TURN: u64 = 500;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Turns of four-bars with cranks of different lengths, some of which do not turn fully.
fn plan(positions: u64) -> Plan {
    Plan::new().grid("a", 30.0, 70.0, positions.div_ceil(TURN)).turn("theta2", TURN)
}

fn query(plan: Plan) -> Result<String> {
    let request = Request { rows_per_chunk: Some(ROWS_PER_CHUNK), ..plan.into() };
    Ok(format!("SELECT min(mu), max(mu) FROM sweep('four_bar', '{}')", request.to_json()?))
}

fn context(threads: usize) -> Result<SessionContext> {
    let config = session(Mechanisms::default()).copied_config().with_target_partitions(threads);
    let context = SessionContext::new_with_config(config);
    register(&context, Mechanisms::built_in()?);
    Ok(context)
}

/// The two numbers of a result.
fn extremes(batches: &[RecordBatch]) -> Option<[u64; 2]> {
    let batch = batches.first()?;
    Some([0, 1].map(|column| batch.column(column).as_primitive::<Float64Type>().value(0).to_bits()))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Prints the rows per second of both, and the median of the ratio of their times.
fn overhead(threads: usize, rounds: usize) -> Result<()> {
    let plan = plan(1_000_000);
    let branch = FourBarBranch::new(Elbow::Left);
    let sweep = Sweep::new(&FourBar::default(), branch, plan.clone())?;
    let sweep = sweep.with_rows_per_chunk(ROWS_PER_CHUNK)?.with_threads(threads)?;
    let (rows, query) = (sweep.rows() as f64, query(plan)?);
    let context = context(threads)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(threads).build()?;
    let [mut alone, mut engine, mut ratio] = [const { Vec::new() }; 3];
    for _ in 0..rounds {
        let start = Instant::now();
        let range = sweep.reduce(&Extremes::of(found("mu")), |_| ControlFlow::Continue(()))?;
        let time = start.elapsed().as_secs_f64();
        let start = Instant::now();
        // A task, so that it runs on the threads of the runtime and not on this one.
        let answer = context.clone();
        let text = query.clone();
        let batches = runtime.block_on(runtime.spawn(async move { answer.sql(&text).await?.collect().await }))??;
        let by_engine = start.elapsed().as_secs_f64();
        let numbers = [range.least, range.most].map(|extreme| extreme.map(|extreme| extreme.value.to_bits()));
        if extremes(&batches).map(|numbers| numbers.map(Some)) != Some(numbers) {
            return Err("the numbers differ".into());
        }
        alone.push(time);
        engine.push(by_engine);
        ratio.push(by_engine / time);
    }
    let speed = |times: Vec<f64>| rows / median(times) / 1e6;
    println!(
        "{threads} threads, {rounds} rounds: linkage-sweep {:.2} million rows/s, SQL {:.2}, ratio of times {:.3}",
        speed(alone),
        speed(engine),
        median(ratio),
    );
    Ok(())
}

/// The largest memory of the process so far in MB, as Linux counts it.
fn peak() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()? / 1000.0)
}

/// Prints the time and the largest memory of one query.
fn memory(positions: u64) -> Result<()> {
    let threads = std::thread::available_parallelism()?.get();
    let (plan, context) = (plan(positions), context(threads)?);
    let rows = plan.factors.iter().map(linkage_sweep::Factor::count).product::<u64>();
    let query = query(plan)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(threads).enable_time().build()?;
    let print = |part, seconds: f64| println!("{part}: {seconds:.1} s, at most {:.1} MB", peak().unwrap_or(f64::NAN));
    let start = Instant::now();
    let batches = runtime.block_on(async {
        let plan = context.sql(&query).await?.create_physical_plan().await?;
        let answer = tokio::spawn(collect(Arc::clone(&plan), context.task_ctx()));
        while !answer.is_finished() && progress(&plan).chunks_done * 10 < progress(&plan).chunks {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
        print("a tenth", start.elapsed().as_secs_f64());
        Ok::<_, Box<dyn Error>>(answer.await??)
    })?;
    let seconds = start.elapsed().as_secs_f64();
    print("all", seconds);
    println!("{rows} rows, {:.2} million rows/s", rows as f64 / seconds / 1e6);
    println!("{}", datafusion::arrow::util::pretty::pretty_format_batches(&batches)?);
    Ok(())
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["overhead", rounds] => {
            let (all, rounds) = (std::thread::available_parallelism()?.get(), rounds.parse()?);
            overhead(1, rounds)?;
            overhead(all, rounds)
        }
        ["memory", positions] => memory(positions.parse()?),
        _ => Err("cost overhead ROUNDS, or cost memory POSITIONS".into()),
    }
}
