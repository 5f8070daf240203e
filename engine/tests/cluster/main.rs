//! Queries on a Ballista cluster.

mod digits;
mod failures;
mod inputs;
mod processes;
