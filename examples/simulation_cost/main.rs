//! Accuracy and time of simulation by method, tolerance and formulation, compared with other crates: Andrews' squeezing
//! mechanism, windows with change points, and a four-bar with and without a spring.
//!
//! `cargo run --release --example simulation_cost` prints the tables and writes `target/simulation_cost.html` and
//! `.svg`; with `-- --patient` it measures more often. With the crate `diffsol`, which adds 52 packages to the build:
//! `cargo run --release --manifest-path examples/simulation_cost/with_diffsol/Cargo.toml`.

use std::error::Error;

mod chart;
mod fixed_steps;
mod formulations;
mod four_bars;
mod integrators;
mod list;
#[path = "../output/mod.rs"]
mod output;
mod page;
#[path = "../price/mod.rs"]
mod price;
mod problem;
mod problems;
mod reading;
mod report;

fn main() -> Result<(), Box<dyn Error>> {
    report::write(report::Problems::new().works())
}
