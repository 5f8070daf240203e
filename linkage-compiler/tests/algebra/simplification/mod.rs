//! Simplification: what each rule does, that it preserves meaning, and what it takes for granted.

mod random;
mod rules;
