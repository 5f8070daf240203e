//! Sessions with the table functions.

use std::sync::Arc;

use datafusion::prelude::{SessionConfig, SessionContext};

use crate::function::SweepFunction;
use crate::unsupported::{Dropped, Places};
use crate::{Mechanisms, TableKind};

/// A session of DataFusion with the table functions `sweep` and `cases`, and a partition for each core.
///
/// Upper and lower case of names differ, as in mechanisms: a parameter `L` needs no quotes.
#[must_use]
pub fn session(mechanisms: Mechanisms) -> SessionContext {
    let mut config = SessionConfig::new();
    config.options_mut().sql_parser.enable_ident_normalization = false;
    let context = SessionContext::new_with_config(config);
    register(&context, mechanisms);
    context
}

/// Adds the table functions `sweep` and `cases` to a session.
///
/// Queries that DataFusion would answer wrongly or never are then errors: `TABLESAMPLE`, which it ignores, and `COPY` to a
/// place that cannot be written.
pub fn register(context: &SessionContext, mechanisms: Mechanisms) {
    context.add_analyzer_rule(Arc::new(Places(context.runtime_env())));
    // It fails only in a build without SQL.
    let _ = context.register_relation_planner(Arc::new(Dropped));
    let mechanisms = Arc::new(mechanisms);
    for kind in [TableKind::Sweep, TableKind::Cases] {
        let mechanisms = Arc::clone(&mechanisms);
        context.register_udtf(kind.function(), Arc::new(SweepFunction { kind, mechanisms }));
    }
}
