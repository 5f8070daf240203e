//! Certified motions, and velocities over boxes.

mod boxes;
mod curves;
mod errors;
mod extremes;
mod loops;
mod on_turns;
mod random;
mod series;
mod shapes;
mod tolerances;
mod turns;
