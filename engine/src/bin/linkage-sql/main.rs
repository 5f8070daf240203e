//! The command line: SQL on sweeps of the built-in mechanisms.

mod cluster;
mod interrupt;
mod log;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::{Parser, Subcommand};
use datafusion::arrow::util::pretty::pretty_format_batches;
use datafusion::physical_plan::{ExecutionPlan, collect, execute_stream};
use datafusion::prelude::SessionContext;
use linkage_engine::cluster::{Cluster, ClusterError, ClusterProgress};
use linkage_engine::{EngineError, Mechanisms, print, progress, session, write_parquet};

use self::log::say;

/// SQL on sweeps of planar linkages.
#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Answers a query in this process.
    Sql {
        /// The query, for example SELECT count(*) FROM sweep('four_bar', '{"factors": [...]}').
        query: String,
        /// Writes the result to this Parquet file. Otherwise it is printed.
        #[arg(long)]
        parquet: Option<PathBuf>,
        /// Prints the number of computed chunks each second, or of computed partitions on a cluster.
        #[arg(long)]
        progress: bool,
        /// Answers the query on the cluster of this scheduler, HOST:PORT.
        #[arg(long)]
        scheduler: Option<String>,
        /// The partitions of a scan on a cluster, each a task.
        #[arg(long, default_value_t = Cluster::PARTITIONS, requires = "scheduler")]
        partitions: usize,
        /// The number of seconds to wait for executors.
        #[arg(long, default_value_t = 30, requires = "scheduler")]
        wait: u64,
    },
    /// Runs the scheduler of a cluster.
    Scheduler(cluster::SchedulerArguments),
    /// Runs an executor of a cluster.
    Executor(cluster::ExecutorArguments),
}

#[tokio::main]
async fn main() -> ExitCode {
    match run(Arguments::parse().command).await {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(format_args!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

async fn run(command: Command) -> Result<(), ClusterError> {
    let mechanisms = Mechanisms::built_in()?;
    if matches!(&command, Command::Sql { parquet: Some(_), .. }) {
        interrupt::leave_no_part();
    }
    match command {
        Command::Sql { query, parquet, progress, scheduler: Some(scheduler), partitions, wait } => {
            let cluster = Cluster::new(scheduler, mechanisms)?;
            let cluster = cluster.with_partitions(partitions).with_wait(Duration::from_secs(wait));
            let print = |ClusterProgress { partitions_done, partitions }| {
                say(format_args!("{partitions_done} of {partitions} partitions"));
            };
            let cluster = if progress { cluster.with_progress(Duration::from_secs(1), print) } else { cluster };
            cluster::answer(&cluster, &query, parquet).await
        }
        Command::Scheduler(arguments) => cluster::scheduler(arguments).await,
        Command::Executor(arguments) => cluster::executor(arguments, mechanisms).await,
        Command::Sql { query, parquet, progress, .. } => {
            let context = session(mechanisms);
            let plan = context.sql(&query).await?.create_physical_plan().await?;
            if progress {
                let plan = Arc::clone(&plan);
                // The timers of the runtime wait while all its threads compute. The thread ends with the process.
                std::thread::spawn(move || print_progress(&plan));
            }
            Ok(answer(&context, plan, parquet).await?)
        }
    }
}

/// Prints or writes the result of a query.
async fn answer(
    context: &SessionContext,
    plan: Arc<dyn ExecutionPlan>,
    parquet: Option<PathBuf>,
) -> Result<(), EngineError> {
    match parquet {
        Some(path) => {
            let rows = write_parquet(execute_stream(plan, context.task_ctx())?, &path).await?;
            print(format_args!("{rows} rows in {}", path.display()))?;
        }
        None => print(pretty_format_batches(&collect(plan, context.task_ctx()).await?)?)?,
    }
    Ok(())
}

/// Prints the number of computed chunks each second.
fn print_progress(plan: &Arc<dyn ExecutionPlan>) {
    loop {
        std::thread::sleep(Duration::from_secs(1));
        let done = progress(plan);
        say(format_args!("{} of {} chunks", done.chunks_done, done.chunks));
    }
}
