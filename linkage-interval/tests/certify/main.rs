//! Certified motions.
#![cfg(test)]

mod loops;
mod shapes;
mod turns;
