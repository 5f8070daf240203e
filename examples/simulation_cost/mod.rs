//! Errors and times of simulations.

pub mod chart;
pub mod fixed_steps;
pub mod formulations;
pub mod four_bars;
pub mod integrators;
pub mod list;
pub mod page;
pub mod problem;
pub mod problems;
pub mod reading;
pub mod report;
