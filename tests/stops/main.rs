//! Stops at zero, where roundings have no scale, in positions in which the inputs are singular.

mod crank;
mod five_bar;
mod ladder;

/// What rounding may leave of a place, beside what is large for it.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
