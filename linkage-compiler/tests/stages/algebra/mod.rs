//! Proofs of the algebra: a decision procedure proves every simplification equal to its original.

mod equality;
mod formula;
mod simplification;
