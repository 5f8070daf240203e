//! Simulations over time.

mod held;
mod integrate_mechanism;
mod simulation;
mod simulation_cost;
