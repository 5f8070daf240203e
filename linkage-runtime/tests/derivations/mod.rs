//! Derivations to write down.

pub mod four_bar;
