//! Simulations over time.

mod held;
mod integrate_mechanism;
mod run_time_scenes;
mod simulation;
mod simulation_cost;
