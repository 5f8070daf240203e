//! Certified motions.

mod curves;
mod errors;
mod extremes;
mod loops;
mod random;
mod series;
mod shapes;
mod tolerances;
mod turns;
