//! Other ways to the numbers of the tests: the compiler's interpreter in doubles and in 48 digits, and the forces of
//! machines in 48 digits.

mod along;
mod close;
mod interpreter;
mod jet;
pub mod laws;
pub mod newton_euler;
pub mod precise;
pub mod scalars;
pub mod tape;

pub use close::{all_close, close};
pub use interpreter::{Oracle, Sample};
