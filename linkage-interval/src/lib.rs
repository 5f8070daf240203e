//! Intervals of real numbers, and certified motions of linkages.

#![warn(missing_docs)]

mod interval;

pub use interval::Interval;
