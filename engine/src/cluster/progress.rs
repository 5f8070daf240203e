//! The progress of a query on a cluster.

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use serde::Deserialize;
use tokio::time::sleep;

use super::{TaskScan, transport};

/// The partitions of all scans of a query on a cluster.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ClusterProgress {
    /// The number of partitions that are computed. It falls when an executor is lost: its partitions run again.
    pub partitions_done: usize,
    /// The number of partitions.
    pub partitions: usize,
}

/// A job in the list of a scheduler.
#[derive(Deserialize)]
struct Job {
    job_id: String,
    job_name: String,
}

/// The stages of a job, as a scheduler describes them.
#[derive(Deserialize)]
struct Stages {
    stages: Vec<Stage>,
}

#[derive(Deserialize)]
struct Stage {
    /// The plan as text; none of a stage that waits for others.
    stage_plan: Option<String>,
    tasks: Vec<Option<Task>>,
}

#[derive(Deserialize)]
struct Task {
    /// "Running", "Successful", or an object with the reason of a failure.
    status: serde_json::Value,
    partition_id: Vec<u32>,
}

impl Stages {
    /// The number of partitions of scans that are computed.
    fn partitions_done(&self) -> usize {
        let scans = self.stages.iter().filter(|stage| stage.stage_plan.as_deref().is_some_and(TaskScan::is_in));
        let tasks = scans.flat_map(|stage| stage.tasks.iter().flatten());
        tasks.filter(|task| task.status == "Successful").map(|task| task.partition_id.len()).sum()
    }
}

/// Reports of the progress of queries.
#[derive(Clone)]
pub(super) struct Reports {
    /// The time between two of them.
    pub every: Duration,
    pub report: Arc<dyn Fn(ClusterProgress) + Send + Sync>,
}

impl Reports {
    /// Reports the progress of a job. A question that a scheduler does not answer is asked again: that it is gone is
    /// noticed by the query.
    pub async fn of(&self, scheduler: &str, job: &str, partitions: usize) -> Infallible {
        loop {
            sleep(self.every).await;
            if let Some(partitions_done) = partitions_done(scheduler, job).await {
                (self.report)(ClusterProgress { partitions_done, partitions });
            }
        }
    }
}

/// The number of partitions of scans that a job has computed.
async fn partitions_done(scheduler: &str, job: &str) -> Option<usize> {
    let jobs: Vec<Job> = transport::json(scheduler, "/api/jobs").await?;
    let id = jobs.into_iter().find(|found| found.job_name == job)?.job_id;
    let stages: Stages = transport::json(scheduler, &format!("/api/job/{id}/stages")).await?;
    Some(stages.partitions_done())
}
