//! The oracle: a motion with contacts by small steps and enumeration.
//!
//! It shares nothing with the library but the laws. Its coordinates are others than those of the scene; its modes and
//! impacts are found by trying all combinations; its integrator extrapolates the midpoint rule, and any time within a step is
//! reached by a shorter step.

mod enumeration;
mod event_loop;
mod extrapolation;
mod linear;
mod model;
mod moved;
mod settle;

pub use event_loop::{Start, Track, free_acceleration, track};
pub use model::{Law, Model, N, Row, Rows, Scales, Vector, row, rows};
pub use moved::Kick;
