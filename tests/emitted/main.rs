//! The emitted code: its text, its formulas, its operations.

mod derivation;
mod effects;
mod emitted_source;
mod expansion;
mod formulas;
mod lent_formulas;
mod operations;
mod program;
