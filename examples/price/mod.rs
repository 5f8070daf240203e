//! What the price lists share.

pub mod axes;
pub mod frontier;

/// The style of their pages.
pub const STYLE: &str = include_str!("style.css");
