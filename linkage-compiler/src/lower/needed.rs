//! Stages that somebody waits for.

use std::collections::BTreeSet;

use super::Stage;
use crate::graph::Graph;

/// The stages without those that name only what no later one refers to; verdicts all stay.
#[must_use]
pub fn needed(graph: &Graph, stages: Vec<Stage>) -> Vec<Stage> {
    let mut wanted = BTreeSet::new();
    let mut kept = Vec::new();
    for stage in stages.into_iter().rev() {
        let introduced = stage.introduced();
        if introduced.is_empty() || introduced.iter().any(|symbol| wanted.contains(symbol)) {
            wanted.extend(graph.symbols_of(&stage.nodes()));
            kept.push(stage);
        }
    }
    kept.reverse();
    kept
}
