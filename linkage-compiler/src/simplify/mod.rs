//! Equal but better: identities that make a formula shorter or more accurate, and the
//! schedule that turns shared nodes into straight-line steps.

pub mod equality;
mod rational;
pub mod schedule;
mod trigonometric;

pub use rational::factor;
pub use trigonometric::determinant;
