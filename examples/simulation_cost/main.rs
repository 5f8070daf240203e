//! The price of accuracy for simulation: error against time of methods, tolerances and formulations, ours beside other
//! crates', on Andrews' squeezing mechanism, on falling windows with change points and on a four-bar, with a spring and
//! without.
//!
//! `cargo run --release --example simulation_cost` prints it and writes `target/simulation_cost.html` and `.svg`; with
//! `-- --patient` it times more often. With the crate `diffsol` beside the others, which brings 52 packages along that
//! nothing else here needs:
//! `cargo run --release --manifest-path examples/simulation_cost/with_diffsol/Cargo.toml`.

use std::error::Error;

mod chart;
mod fixed_steps;
mod formulations;
mod four_bars;
mod integrators;
mod list;
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
