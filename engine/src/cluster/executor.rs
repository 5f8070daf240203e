//! Executors.

use std::sync::Arc;

use ballista_executor::executor_process::{ExecutorProcessConfig, start_executor_process};

use super::{ClusterError, SweepCodec, transport};
use crate::Mechanisms;

/// The options of an [`executor`].
#[derive(Debug, Clone)]
pub struct ExecutorOptions {
    /// The address of the scheduler, `HOST:PORT`.
    pub scheduler: String,
    /// The address to listen at: the network that it is of can read results of tasks, without a password.
    pub bind: String,
    /// The host by which the others reach this executor; without it the address that the scheduler sees.
    pub advertise: Option<String>,
    /// The port for results; 0 takes one that is free.
    pub port: u16,
    /// The port for tasks; 0 takes one that is free.
    pub task_port: u16,
    /// The number of tasks at a time; 0 for one per core.
    pub tasks: usize,
    /// The number of seconds between two signs of life.
    pub heartbeat: u64,
}

impl Default for ExecutorOptions {
    fn default() -> Self {
        Self {
            scheduler: "127.0.0.1:50050".to_owned(),
            bind: "127.0.0.1".to_owned(),
            advertise: None,
            port: 0,
            task_port: 0,
            tasks: 0,
            heartbeat: 2,
        }
    }
}

/// Computes tasks until the process is asked to end or the scheduler is gone.
///
/// # Errors
/// [`ClusterError::Listen`] if a port is in use, [`ClusterError::Unreachable`] if there is no scheduler,
/// [`ClusterError::Process`] after a failure.
pub async fn executor(mechanisms: Mechanisms, options: ExecutorOptions) -> Result<(), ClusterError> {
    let (scheduler_host, scheduler_port) = host_and_port(&options.scheduler)?;
    transport::answers(&options.scheduler).await?;
    // Ballista opens the ports itself and says nothing about an address when one is in use.
    let (results, address) = transport::listen("executor", &options.bind, options.port).await?;
    let (tasks, task_address) = transport::listen("executor", &options.bind, options.task_port).await?;
    drop((results, tasks));
    let folder = tempfile::Builder::new().prefix("linkage-executor-").tempdir().map_err(ClusterError::Folder)?;
    let config = ExecutorProcessConfig {
        bind_host: address.ip().to_string(),
        external_host: options.advertise,
        port: address.port(),
        grpc_port: task_address.port(),
        scheduler_host,
        scheduler_port,
        vcores: options.tasks,
        work_dir: Some(folder.path().to_string_lossy().into_owned()),
        executor_heartbeat_interval_seconds: options.heartbeat,
        override_physical_codec: Some(Arc::new(SweepCodec::of_executor(mechanisms, address.to_string()))),
        ..ExecutorProcessConfig::default()
    };
    let ended = |source| ClusterError::Process { role: "executor", address: address.to_string(), source };
    start_executor_process(Arc::new(config)).await.map_err(ended)
}

/// The parts of an address.
pub(super) fn host_and_port(address: &str) -> Result<(String, u16), ClusterError> {
    let parts = address.rsplit_once(':').and_then(|(host, port)| Some((host, port.parse().ok()?)));
    let (host, port) =
        parts.filter(|(host, _)| !host.is_empty()).ok_or_else(|| ClusterError::Address(address.to_owned()))?;
    Ok((host.to_owned(), port))
}
