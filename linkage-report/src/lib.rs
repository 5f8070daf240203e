//! Documents and drawings of linkages.
//!
//! - [`Document`]: a derivation as plain text and as LaTeX, its code as FPCore;
//! - [`Notation`]: a formula as LaTeX and MathML;
//! - [`report`]: mobility, modes, and one motion from end to end, as data, prose and HTML;
//! - [`sheet`]: a derivation as HTML, with numbers and pictures;
//! - [`drawing`]: a linkage as SVG;
//! - [`Table`]: a motion as columns and as CSV.

#![warn(missing_docs)]

mod document;
#[cfg(feature = "drawing")]
pub mod drawing;
mod fpcore;
mod notation;
pub mod report;
pub mod sheet;
mod table;

pub use document::Document;
pub use fpcore::FpCore;
pub use notation::Notation;
pub use table::Table;
