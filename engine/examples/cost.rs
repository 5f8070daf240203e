//! Time and memory of queries of one found column, by `linkage-sweep` alone and by SQL.
//!
//! Run it with `--release`. `cost overhead ROUNDS` takes fifty million positions, in chunks of 100 000, on one thread and on
//! all: the number of positions in which the column exists, which costs next to nothing to reduce, then the extremes. Rounds of both take
//! turns, and the median is that of the ratio within a round. `cost memory POSITIONS` answers
//! one query of that many positions, and prints the largest memory at a tenth of the chunks and at the end.

use std::error::Error;
use std::fs;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use datafusion::arrow::array::{ArrayRef, AsArray, RecordBatch};
use datafusion::arrow::datatypes::{Float64Type, Int64Type};
use datafusion::physical_plan::collect;
use datafusion::prelude::SessionContext;
use linkage::Elbow;
use linkage::lanes::Lanes;
use linkage_engine::mechanisms::{FourBar, FourBarBranch};
use linkage_engine::{Mechanisms, Request, print, progress, register, session};
use linkage_sweep::{Block, Column, Extremes, Place, Plan, Reducer, Sweep, SweepError, found};

const ROWS_PER_CHUNK: usize = 100_000;
/// The rows of a turn.
const TURN: u64 = 500;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Turns of four-bars with cranks of different lengths, some of which do not turn fully.
fn plan(positions: u64) -> Plan {
    Plan::new().grid("a", 30.0, 70.0, positions.div_ceil(TURN)).turn("theta2", TURN)
}

fn query(what: &str, plan: Plan) -> Result<String> {
    let request = Request { rows_per_chunk: Some(ROWS_PER_CHUNK), ..plan.into() };
    Ok(format!("SELECT {what} FROM sweep('four_bar', '{}')", request.to_json()?))
}

fn context(threads: usize) -> Result<SessionContext> {
    let config = session(Mechanisms::default()).copied_config().with_target_partitions(threads);
    let context = SessionContext::new_with_config(config);
    register(&context, Mechanisms::built_in()?);
    Ok(context)
}

/// The numbers of a result by their bits.
fn numbers(batches: &[RecordBatch]) -> Vec<u64> {
    let columns = batches.iter().flat_map(RecordBatch::columns);
    let number = |column: &ArrayRef| match column.as_primitive_opt::<Float64Type>() {
        Some(floats) => floats.value(0).to_bits(),
        None => column.as_primitive::<Int64Type>().value(0).cast_unsigned(),
    };
    columns.map(number).collect()
}

/// Counts the rows in which a column exists.
struct Existing(Column);

impl<M: Lanes> Reducer<M> for Existing {
    type Part = (Place, u64);
    type Output = u64;

    fn columns(&self) -> Vec<Column> {
        vec![self.0.clone()]
    }

    fn start(&self) -> std::result::Result<Self::Part, SweepError> {
        Ok((self.0.place::<M>()?, 0))
    }

    fn fold(&self, (place, count): &mut Self::Part, block: &Block<'_, M>) {
        *count += block.accepted(*place).count() as u64;
    }

    fn merge(&self, (_, count): &mut Self::Part, (_, other): Self::Part) {
        *count += other;
    }

    fn finish(&self, (_, count): Self::Part) -> u64 {
        count
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Prints the rows per second of both, and the median of the ratio of their times.
fn overhead(threads: usize, rounds: usize) -> Result<()> {
    let plan = plan(50_000_000);
    let branch = FourBarBranch::new(Elbow::Left);
    let sweep = Sweep::new(&FourBar::default(), branch, plan.clone())?;
    let sweep = sweep.with_rows_per_chunk(ROWS_PER_CHUNK)?.with_threads(threads)?;
    let context = context(threads)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(threads).build()?;
    let compare = |what: &str, alone: &dyn Fn() -> Result<Vec<u64>>| -> Result<()> {
        let query = query(what, plan.clone())?;
        let [mut by_sweep, mut by_sql, mut ratio] = [const { Vec::new() }; 3];
        for _ in 0..rounds {
            let start = Instant::now();
            let expected = alone()?;
            by_sweep.push(start.elapsed().as_secs_f64());
            let start = Instant::now();
            // A task, so that it runs on the threads of the runtime and not on this one.
            let (context, query) = (context.clone(), query.clone());
            let batches =
                runtime.block_on(runtime.spawn(async move { context.sql(&query).await?.collect().await }))??;
            by_sql.push(start.elapsed().as_secs_f64());
            if numbers(&batches) != expected {
                return Err("the numbers differ".into());
            }
            ratio.extend(by_sql.last().zip(by_sweep.last()).map(|(sql, sweep)| sql / sweep));
        }
        let speed = |times: Vec<f64>| sweep.rows() as f64 / median(times) / 1e6;
        let (by_sweep, by_sql, ratio) = (speed(by_sweep), speed(by_sql), median(ratio));
        print(format_args!(
            "{threads} threads, {what}: {by_sweep:.2} million rows/s alone, {by_sql:.2} by SQL, {ratio:.3} of the time"
        ))?;
        Ok(())
    };
    let go_on = |_| ControlFlow::Continue(());
    compare("count(mu)", &|| Ok(vec![sweep.reduce(&Existing(found("mu")), go_on)?]))?;
    compare("min(mu), max(mu)", &|| {
        let range = sweep.reduce(&Extremes::of(found("mu")), go_on)?;
        Ok([range.least, range.most].into_iter().flatten().map(|extreme| extreme.value.to_bits()).collect())
    })
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
    let query = query("min(mu), max(mu)", plan)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(threads).build()?;
    let report = |part, seconds: f64| {
        print(format_args!("{part}: {seconds:.1} s, at most {:.1} MB", peak().unwrap_or(f64::NAN)))
    };
    let start = Instant::now();
    let plan = runtime.block_on(async { context.sql(&query).await?.create_physical_plan().await })?;
    let answer = runtime.spawn(collect(Arc::clone(&plan), context.task_ctx()));
    // The timers of the runtime wait while all its threads compute.
    while !answer.is_finished() && progress(&plan).chunks_done * 10 < progress(&plan).chunks {
        std::thread::sleep(Duration::from_millis(10));
    }
    report("a tenth", start.elapsed().as_secs_f64())?;
    let batches = runtime.block_on(answer)??;
    let seconds = start.elapsed().as_secs_f64();
    report("all", seconds)?;
    print(format_args!("{rows} rows, {:.2} million rows/s", rows as f64 / seconds / 1e6))?;
    Ok(print(datafusion::arrow::util::pretty::pretty_format_batches(&batches)?)?)
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
