//! Notations of formulas: the rules that all share, and Unicode.
//!
//! `writer` decides on signs, fractions and brackets and calls a [`Style`] for the rest. LaTeX and MathML are styles of
//! the crate `linkage-report`.

mod name;
mod style;
mod unicode;
mod writer;

pub use name::{Name, Word, greek, is_number, latin, numbered_greek, primes};
pub use style::{Argument, Binding, Marks, Style, is_circular};
pub use unicode::Unicode;
pub use writer::write;
