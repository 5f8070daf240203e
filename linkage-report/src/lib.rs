//! Documents and drawings of linkages.
//!
//! - [`Document`]: a derivation as plain text and as LaTeX, its code as FPCore;
//! - [`Notation`]: a formula as LaTeX and MathML;
//! - [`report`]: mobility, modes, and one motion from end to end, as data, prose and HTML;
//! - [`sheet`]: a derivation as HTML, with numbers and pictures;
//! - [`drawing`]: a linkage as SVG;
//! - [`chart`]: curves over axes as SVG;
//! - `price`: errors and times of a mechanism and of a scene, with the feature `double-double`;
//! - `lend`: documents of mechanisms that were compiled while the program runs, with the feature `lend`;
//! - [`table`]: motions, loads and simulations as columns, as CSV and JSON.

#![warn(missing_docs)]

pub mod chart;
mod document;
#[cfg(feature = "drawing")]
pub mod drawing;
mod fpcore;
#[cfg(feature = "lend")]
pub mod lend;
mod notation;
#[cfg(feature = "double-double")]
pub mod price;
pub mod report;
pub mod sheet;
pub mod table;
mod words;

pub use document::Document;
pub use fpcore::FpCore;
pub use notation::Notation;
pub use table::Table;
