//! Accuracy and time of simulation by method, tolerance and formulation, compared with other crates: Andrews' squeezing
//! mechanism, windows with change points, and a four-bar with and without a spring.
//!
//! `cargo run --release --example simulation_cost` prints the tables and writes
//! `target/simulation_cost.html`; with `-- --patient` it measures more often. With the crate `diffsol`, which adds 52 packages to the build:
//! `cargo run --release --manifest-path examples/simulation_cost/with_diffsol/Cargo.toml`.

use std::error::Error;

mod others;

use linkage_examples::simulation_cost::report;

fn main() -> Result<(), Box<dyn Error>> {
    let problems = report::Problems::all();
    report::write(problems.works(others::works(&problems)))
}
