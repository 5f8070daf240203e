//! Shared parts of the comparisons of error and time.

/// The style of the pages.
pub const STYLE: &str = include_str!("style.css");
