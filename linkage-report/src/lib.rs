//! Documents and drawings of linkages.
//!
//! - [`Document`]: a derivation as plain text and as LaTeX, its code as FPCore;
//! - [`sheet`]: a derivation as HTML, with numbers and pictures;
//! - [`drawing`]: a linkage as SVG;
//! - [`Table`]: a motion as columns and as CSV.

#![warn(missing_docs)]

mod document;
#[cfg(feature = "drawing")]
pub mod drawing;
mod fpcore;
pub mod sheet;
mod table;

pub use document::Document;
pub use fpcore::FpCore;
pub use table::Table;
