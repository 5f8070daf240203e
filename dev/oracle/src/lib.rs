//! Other ways to the numbers of the tests: the compiler's interpreter in doubles and in 48 digits.

mod close;
mod interpreter;
pub mod laws;
pub mod precise;
pub mod tape;

pub use close::{all_close, close};
pub use interpreter::{Oracle, Sample};
