//! Schedulers.

use std::fmt;
use std::net::SocketAddr;
use std::sync::Arc;

use ballista_core::serde::BallistaLogicalExtensionCodec;
use ballista_scheduler::cluster::BallistaCluster;
use ballista_scheduler::config::{SchedulerConfig, TaskDistributionPolicy};
use ballista_scheduler::scheduler_process::{create_scheduler, start_grpc_service_with_listener};
use datafusion_proto::protobuf::{LogicalPlanNode, PhysicalPlanNode};
use tokio::net::TcpListener;

use super::{ATTEMPTS, ClusterError, SweepCodec, transport};

/// The options of a [`Scheduler`].
#[derive(Debug, Clone)]
pub struct SchedulerOptions {
    /// The host to listen at: the network that it is an address of can send jobs and read results, without a password.
    pub bind: String,
    /// The port; 0 takes one that is free.
    pub port: u16,
    /// The host by which executors reach the scheduler; without it the one it listens at.
    pub advertise: Option<String>,
    /// The number of executors that a query waits for.
    pub executors: usize,
    /// An executor that is silent for this number of seconds is lost.
    pub timeout: u64,
}

impl Default for SchedulerOptions {
    fn default() -> Self {
        Self { bind: "127.0.0.1".to_owned(), port: 50050, advertise: None, executors: 1, timeout: 10 }
    }
}

/// The process that plans jobs and hands out their tasks.
pub struct Scheduler {
    listener: TcpListener,
    address: SocketAddr,
    config: Arc<SchedulerConfig>,
}

impl Scheduler {
    /// Listens.
    ///
    /// # Errors
    /// [`ClusterError::Listen`] if the port is in use, [`ClusterError::NoName`] if others cannot reach it.
    pub async fn bind(options: SchedulerOptions) -> Result<Self, ClusterError> {
        let (listener, address) = transport::listen("scheduler", &options.bind, options.port).await?;
        let host = match options.advertise {
            Some(host) => host,
            None if address.ip().is_unspecified() => return Err(ClusterError::NoName),
            None => options.bind.clone(),
        };
        let config = SchedulerConfig {
            external_host: host,
            bind_host: options.bind,
            bind_port: address.port(),
            task_distribution: TaskDistributionPolicy::RoundRobin,
            executor_timeout_seconds: options.timeout,
            expire_dead_executor_interval_seconds: (options.timeout / 4).max(1),
            no_executors_grace_period_seconds: options.timeout,
            min_ready_executors: options.executors,
            task_max_failures: ATTEMPTS,
            override_logical_codec: Some(Arc::new(BallistaLogicalExtensionCodec::default())),
            override_physical_codec: Some(Arc::new(SweepCodec::default())),
            ..SchedulerConfig::default()
        };
        Ok(Self { listener, address, config: Arc::new(config) })
    }

    /// The address that it listens at.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Answers until the process ends.
    ///
    /// # Errors
    /// [`ClusterError::Process`].
    pub async fn serve(self) -> Result<(), ClusterError> {
        let address = self.address.to_string();
        let ended = |source| ClusterError::Process { role: "scheduler", address, source };
        let serve = async {
            let cluster = BallistaCluster::new_from_config(&self.config).await?;
            let server = create_scheduler::<LogicalPlanNode, PhysicalPlanNode>(cluster, self.config).await?;
            start_grpc_service_with_listener(self.listener, server).await
        };
        serve.await.map_err(ended)
    }
}

impl fmt::Debug for Scheduler {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scheduler").field("address", &self.address).finish_non_exhaustive()
    }
}
