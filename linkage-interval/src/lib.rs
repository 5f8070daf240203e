//! Intervals of real numbers, and certified motions of linkages.

#![warn(missing_docs)]

pub mod certify;
mod interval;

pub use interval::Interval;
