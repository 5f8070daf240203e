//! Documents and drawings of linkages.
//!
//! - [`Document`]: a derivation as plain text and as LaTeX;
//! - [`sheet`]: a derivation as HTML, with numbers and pictures;
//! - [`drawing`]: a linkage as SVG.

#![warn(missing_docs)]

mod document;
#[cfg(feature = "drawing")]
pub mod drawing;
pub mod sheet;

pub use document::Document;
