//! Stops at zero, where an absolute rounding error has no scale, in positions in which the inputs are singular.

mod crank;
mod declared;
mod five_bar;
mod ladder;

/// The rounding error of a position, relative to its scale.
const POSITION_ERROR: f64 = 64.0 * f64::EPSILON;
