//! Shared parts of the comparisons of error and time.

pub mod axes;
pub mod frontier;

/// The style of the pages.
pub const STYLE: &str = include_str!("style.css");
