//! Simplification: the result of each rule, its equality with the original, and its assumptions.

mod random;
mod rules;
