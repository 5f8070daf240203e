//! The commands of clusters.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use datafusion::arrow::util::pretty::pretty_format_batches;
use datafusion::physical_plan::common::collect;
use linkage_engine::cluster::{Cluster, ClusterError, ExecutorOptions, Scheduler, SchedulerOptions};
use linkage_engine::{Mechanisms, print, write_parquet};
use tokio::signal::unix::{SignalKind, signal};

/// The arguments of a scheduler.
#[derive(Args)]
pub struct SchedulerArguments {
    /// The host to listen at. Everyone who reaches it can send jobs.
    #[arg(long, default_value = "127.0.0.1")]
    bind: String,
    /// The port; 0 takes one that is free.
    #[arg(long, default_value_t = 50050)]
    port: u16,
    /// The host by which executors reach the scheduler, if it is not the one it listens at.
    #[arg(long)]
    advertise: Option<String>,
    /// The number of executors that a query waits for.
    #[arg(long, default_value_t = 1)]
    executors: usize,
    /// An executor that is silent for this number of seconds is lost.
    #[arg(long, default_value_t = 10)]
    timeout: u64,
}

/// The arguments of an executor.
#[derive(Args)]
pub struct ExecutorArguments {
    /// The address of the scheduler.
    #[arg(long, default_value = "127.0.0.1:50050")]
    scheduler: String,
    /// The host to listen at. Everyone who reaches it can read results.
    #[arg(long, default_value = "127.0.0.1")]
    bind: String,
    /// The host by which the others reach this executor; otherwise the address that the scheduler sees.
    #[arg(long)]
    advertise: Option<String>,
    /// The port for results; 0 takes one that is free.
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// The port for tasks; 0 takes one that is free.
    #[arg(long, default_value_t = 0)]
    task_port: u16,
    /// The number of tasks at a time; 0 for one per core.
    #[arg(long, default_value_t = 0)]
    tasks: usize,
    /// The number of seconds between two signs of life.
    #[arg(long, default_value_t = 2)]
    heartbeat: u64,
    /// Writes a line when a partition begins and when it ends.
    #[arg(long)]
    verbose: bool,
}

/// Runs a scheduler until it is interrupted. Its first line is its address.
pub async fn scheduler(arguments: SchedulerArguments) -> Result<(), ClusterError> {
    super::log::of_server(false);
    let SchedulerArguments { bind, port, advertise, executors, timeout } = arguments;
    let options = SchedulerOptions { bind, port, advertise, executors, timeout };
    let scheduler = Scheduler::bind(options).await?;
    // A scheduler serves on without a reader of its address.
    let _ = writeln!(std::io::stdout(), "{}", scheduler.address());
    let mut terminate = signal(SignalKind::terminate()).map_err(ClusterError::Folder)?;
    tokio::select! {
        result = scheduler.serve() => result,
        _ = tokio::signal::ctrl_c() => Ok(()),
        _ = terminate.recv() => Ok(()),
    }
}

/// Runs an executor until it is interrupted or the scheduler is gone.
pub async fn executor(arguments: ExecutorArguments, mechanisms: Mechanisms) -> Result<(), ClusterError> {
    super::log::of_server(arguments.verbose);
    let ExecutorArguments { scheduler, bind, advertise, port, task_port, tasks, heartbeat, verbose: _ } = arguments;
    let options = ExecutorOptions { scheduler, bind, advertise, port, task_port, tasks, heartbeat };
    linkage_engine::cluster::executor(mechanisms, options).await
}

/// Answers a query on a cluster.
pub async fn answer(cluster: &Cluster, query: &str, parquet: Option<PathBuf>) -> Result<(), ClusterError> {
    super::log::of_client();
    match parquet {
        Some(path) => {
            let rows = cluster.answer(query, |rows| write_parquet(rows, &path)).await?;
            print(format_args!("{rows} rows in {}", path.display()))?;
        }
        None => {
            let batches = cluster.answer(query, |rows| async { Ok(collect(rows).await?) }).await?;
            print(pretty_format_batches(&batches).map_err(linkage_engine::EngineError::from)?)?;
        }
    }
    Ok(())
}
