//! The answer to a query, with progress.

use std::error::Error;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use datafusion::physical_plan::collect;
use linkage_engine::{Mechanisms, ScanProgress, progress, session};
use tokio::time::interval;

use crate::query::{self, Row};

/// Answers the query in this process. Each second it prints the progress to the standard error.
pub async fn rows(query: &str) -> Result<Vec<Row>, Box<dyn Error>> {
    let context = session(Mechanisms::built_in()?);
    let plan = context.sql(query).await?.create_physical_plan().await?;
    let mut answer = pin!(collect(Arc::clone(&plan), context.task_ctx()));
    let mut second = interval(Duration::from_secs(1));
    let batches = loop {
        tokio::select! {
            batches = &mut answer => break batches?,
            _ = second.tick() => {
                let ScanProgress { chunks_done, chunks } = progress(&plan);
                eprintln!("{chunks_done} of {chunks} chunks");
            }
        }
    };
    let rows: Option<Vec<Vec<Row>>> = batches.iter().map(query::rows).collect();
    Ok(rows.ok_or("the answer has other columns than the query")?.concat())
}
