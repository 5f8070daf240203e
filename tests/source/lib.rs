//! Shared by the tests: the sources that they read, mutants of them, and the operations that emitted code states.

pub mod expanded;
pub mod mutants;
pub mod programs;
pub mod subjects;
pub mod turn;
pub mod work;

/// The folder of the workspace.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
