//! The compiler behind `linkage!`: tokens in, tokens out.

pub mod derivation;
pub mod diagnostics;
pub mod graph;
pub mod model;
pub mod simplify;
pub mod structure;
pub mod syntax;
