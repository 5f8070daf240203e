//! Queries.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use ballista_core::execution_plans::execute_physical_plan;
use ballista_core::extension::SessionConfigExt;
use datafusion::execution::SendableRecordBatchStream;
use datafusion::execution::context::SQLOptions;
use datafusion::physical_plan::stream::RecordBatchStreamAdapter;
use datafusion::physical_plan::{ExecutionPlan, execute_stream};
use datafusion::prelude::{SessionConfig, SessionContext};
use datafusion_proto::protobuf::PhysicalPlanNode;
use futures::TryStreamExt;

use super::executor::host_and_port;
use super::progress::Reports;
use super::{ATTEMPTS, ClusterError, ClusterProgress, SweepCodec, TaskScan, transport};
use crate::{EngineError, Mechanisms, register};

/// A cluster that queries are sent to.
///
/// A query is planned here. A plan that reads no sweep runs here too.
#[derive(Clone)]
pub struct Cluster {
    scheduler: String,
    context: SessionContext,
    wait: Duration,
    reports: Option<Reports>,
}

impl Cluster {
    /// The partitions of a scan, each a task, unless set otherwise.
    pub const PARTITIONS: usize = 32;
    /// The most partitions of a scan. A task takes milliseconds to send, and the scheduler keeps all of them.
    pub const MOST_PARTITIONS: usize = 4096;

    /// The cluster of a scheduler at `HOST:PORT`, with the mechanisms of its executors.
    ///
    /// # Errors
    /// [`ClusterError::Address`].
    pub fn new(scheduler: impl Into<String>, mechanisms: Mechanisms) -> Result<Self, ClusterError> {
        let scheduler = scheduler.into();
        host_and_port(&scheduler)?;
        let mut config = SessionConfig::new_with_ballista()
            .with_target_partitions(Self::PARTITIONS)
            // One partition per task: a failure repeats no others.
            .set_usize("ballista.scheduler.max_partitions_per_task", 1)
            // Asked again and again, a scheduler that hangs is noticed.
            .set_bool("ballista.client.pull", true);
        config.options_mut().sql_parser.enable_ident_normalization = false;
        let context = SessionContext::new_with_config(config);
        register(&context, mechanisms);
        Ok(Self { scheduler, context, wait: Duration::from_secs(30), reports: None })
    }

    /// Sets the number of partitions of a scan: at least one, and at most [`MOST_PARTITIONS`](Self::MOST_PARTITIONS).
    #[must_use]
    pub fn with_partitions(self, partitions: usize) -> Self {
        let state = self.context.state_ref();
        let partitions = partitions.clamp(1, Self::MOST_PARTITIONS);
        state.write().config_mut().options_mut().execution.target_partitions = partitions;
        self
    }

    /// Sets the time that a query waits for executors.
    #[must_use]
    pub fn with_wait(self, wait: Duration) -> Self {
        Self { wait, ..self }
    }

    /// Calls `report` again and again while a query runs, each time after a pause.
    #[must_use]
    pub fn with_progress(self, every: Duration, report: impl Fn(ClusterProgress) + Send + Sync + 'static) -> Self {
        Self { reports: Some(Reports { every, report: Arc::new(report) }), ..self }
    }

    /// Waits until the scheduler has as many executors as it was started for.
    ///
    /// # Errors
    /// [`ClusterError::Unreachable`] and [`ClusterError::NotReady`].
    pub async fn ready(&self) -> Result<(), ClusterError> {
        transport::ready(&self.scheduler, self.wait).await
    }

    /// Answers a query: hands its rows to `take` and returns the value of that.
    ///
    /// If the executor with the result is lost while `take` reads, the query runs again, [`ATTEMPTS`] times in all, and
    /// `take` begins anew; so it must not show a part of the rows to others.
    ///
    /// # Errors
    /// Those of `take` and of the plan as [`ClusterError::Query`]; [`ClusterError::Job`] if the cluster cannot run it;
    /// those of [`ready`](Self::ready).
    pub async fn answer<T, F>(
        &self,
        sql: &str,
        take: impl Fn(SendableRecordBatchStream) -> F,
    ) -> Result<T, ClusterError>
    where
        F: Future<Output = Result<T, EngineError>>,
    {
        let options = SQLOptions::new().with_allow_ddl(false).with_allow_dml(false);
        let plan = self.context.sql_with_options(sql, options).await?.create_physical_plan().await?;
        if !TaskScan::is_needed(&plan) {
            return Ok(take(execute_stream(plan, self.context.task_ctx())?).await?);
        }
        let plan = TaskScan::distribute(plan)?;
        self.ready().await?;
        let mut attempt = 0;
        loop {
            attempt += 1;
            let lost = Arc::new(AtomicBool::new(false));
            let answer = take(self.submit(Arc::clone(&plan), attempt, Arc::clone(&lost)).await?).await;
            match answer {
                Err(error) if lost.load(Ordering::Relaxed) => {
                    log::warn!("attempt {attempt}: the result is lost: {error}");
                    if attempt == ATTEMPTS {
                        let reason = format!("the executor with the result was lost {attempt} times: {error}");
                        return Err(ClusterError::Job { address: self.scheduler.clone(), reason });
                    }
                }
                answer => return Ok(answer?),
            }
        }
    }

    /// Runs a plan. The rows are there when it returns; `lost` becomes true if they cannot be fetched.
    async fn submit(
        &self,
        plan: Arc<dyn ExecutionPlan>,
        attempt: usize,
        lost: Arc<AtomicBool>,
    ) -> Result<SendableRecordBatchStream, ClusterError> {
        // By its name the job is found among those of the scheduler.
        let job = format!("{}-{attempt}", self.context.session_id());
        let config = self.context.copied_config().with_ballista_job_name(&job);
        let partitions = TaskScan::partitions(&plan);
        let (ballista, codec) = (config.ballista_config(), SweepCodec::default());
        let rows = execute_physical_plan::<PhysicalPlanNode>(
            format!("http://{}", self.scheduler),
            &ballista,
            plan,
            &codec,
            self.context.session_id(),
            config,
        );
        let rows = match &self.reports {
            None => rows.await,
            Some(reports) => tokio::select! {
                rows = rows => rows,
                never = reports.of(&self.scheduler, &job, partitions) => match never {},
            },
        };
        let rows = rows.map_err(|error| ClusterError::job(&self.scheduler, &error))?;
        let schema = rows.schema();
        let rows = rows.inspect_err(move |_| lost.store(true, Ordering::Relaxed));
        Ok(Box::pin(RecordBatchStreamAdapter::new(schema, rows)))
    }
}

impl std::fmt::Debug for Cluster {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cluster").field("scheduler", &self.scheduler).finish_non_exhaustive()
    }
}
