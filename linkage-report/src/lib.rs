//! Linkages on paper.
//!
//! - [`Document`]: a derivation in plain text and as a part of a LaTeX document;
//! - [`sheet`]: a derivation as HTML, with numbers and pictures;
//! - [`drawing`]: a linkage as SVG.

#![warn(missing_docs)]

mod document;
#[cfg(feature = "drawing")]
pub mod drawing;
pub mod sheet;

pub use document::Document;
