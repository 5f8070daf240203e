//! Certified motions.
#![cfg(test)]

mod curves;
mod extremes;
mod loops;
mod shapes;
mod tolerances;
mod turns;
