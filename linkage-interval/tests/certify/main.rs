//! Certified motions.
#![cfg(test)]

mod curves;
mod errors;
mod extremes;
mod loops;
mod shapes;
mod random;
mod tolerances;
mod turns;
