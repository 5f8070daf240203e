//! Accuracy against numbers of many digits, and the bounds of rounding errors that the docs state.

mod accuracy;
mod forty_digits;
mod fpcore;
mod limits_to_forty_digits;
mod rounding;
mod rounding_bounds;
