//! Simulations over time.

mod integrate_mechanism;
mod simulation;
mod simulation_cost;
