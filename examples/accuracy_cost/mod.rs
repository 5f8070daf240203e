//! Errors and times of ways to positions, velocities and accelerations.

pub mod dominance;
pub mod oracle;
