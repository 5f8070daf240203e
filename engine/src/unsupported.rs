//! SQL that DataFusion would ignore, or never answer: an error with a sentence.

use std::fmt::{self, Debug};
use std::fs;
use std::io;
use std::path::Path;
use std::sync::Arc;

use datafusion::common::config::ConfigOptions;
use datafusion::datasource::listing::ListingTableUrl;
use datafusion::error::Result;
use datafusion::execution::runtime_env::RuntimeEnv;
use datafusion::logical_expr::LogicalPlan;
use datafusion::logical_expr::planner::{RelationPlanner, RelationPlannerContext, RelationPlanning};
use datafusion::optimizer::AnalyzerRule;
use datafusion::sql::sqlparser::ast::TableFactor;

use crate::EngineError;

/// Rejects parts of a `FROM` that DataFusion reads and drops, as if they were not there.
#[derive(Debug)]
pub struct Dropped;

impl RelationPlanner for Dropped {
    fn plan_relation(&self, relation: TableFactor, _: &mut dyn RelationPlannerContext) -> Result<RelationPlanning> {
        let rejected = |part, instead| Err(EngineError::Unsupported { part, instead }.into());
        match &relation {
            TableFactor::Table { sample: Some(_), .. } | TableFactor::Derived { sample: Some(_), .. } => {
                rejected("TABLESAMPLE", "a sample of the plan, or WHERE random() < 0.1")
            }
            TableFactor::Table { version: Some(_), .. } => rejected("a version of a table", "the table alone"),
            TableFactor::Table { with_ordinality: true, .. } | TableFactor::Function { with_ordinality: true, .. } => {
                rejected("WITH ORDINALITY", "the column row or case_number")
            }
            TableFactor::Table { partitions, .. } if !partitions.is_empty() => rejected("PARTITION", "WHERE"),
            _ => Ok(RelationPlanning::Original(Box::new(relation))),
        }
    }
}

/// Rejects `COPY` to a place that cannot be written. The writer of DataFusion 55 tries some of these again without end.
pub struct Places(pub Arc<RuntimeEnv>);

impl Debug for Places {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Places").finish_non_exhaustive()
    }
}

impl AnalyzerRule for Places {
    fn analyze(&self, plan: LogicalPlan, _: &ConfigOptions) -> Result<LogicalPlan> {
        if let LogicalPlan::Copy(copy) = &plan {
            let url = ListingTableUrl::parse(&copy.output_url)?;
            let no_store = |_| EngineError::NoStore { place: copy.output_url.clone() };
            self.0.object_store(&url).map_err(no_store)?;
            let url: &url::Url = url.as_ref();
            if let Ok(path) = url.to_file_path() {
                writable(&path).map_err(|(path, source)| EngineError::Place { path, source })?;
            }
        }
        Ok(plan)
    }

    fn name(&self) -> &'static str {
        "places"
    }
}

/// An error with the folder if no file can be made where a path leads: in its folder, or in the one that its missing
/// folders would be made in.
fn writable(path: &Path) -> Result<(), (String, io::Error)> {
    let Some(folder) = path.ancestors().skip(1).find(|folder| fs::symlink_metadata(folder).is_ok()) else {
        return Ok(());
    };
    let failed = |source| (folder.display().to_string(), source);
    if !fs::metadata(folder).map_err(failed)?.is_dir() {
        return Err(failed(io::ErrorKind::NotADirectory.into()));
    }
    // It has no name, or is removed at once.
    tempfile::NamedTempFile::new_in(folder).map(drop).map_err(failed)
}
