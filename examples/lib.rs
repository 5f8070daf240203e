//! Shared by the examples, and the parts of them that the tests check.

pub mod accuracy_cost;
pub mod car_axis;
pub mod door_closer;
pub mod engine;
pub mod output;
pub mod plot;
pub mod price;
pub mod quadrature;
pub mod simulation_cost;
