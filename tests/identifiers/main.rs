//! Names that the expansion or Rust uses, in all places of a mechanism.

mod names;
mod raw_names;
