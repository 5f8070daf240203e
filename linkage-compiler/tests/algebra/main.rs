//! Algebra that proves itself: equality is decided, and every simplification is proved equal to what
//! it came from.

mod equality;
mod formula;
mod simplification;
