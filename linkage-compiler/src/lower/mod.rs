//! Lowering: from shared nodes to straight-line code, every subexpression once, every sum or product of two
//! parts that several have in common once, one sine-cosine pair an angle.
//!
//! The formulas of a kernel are translated, shared, joined, and their factors and lines ordered ([`schedule`]); results are
//! proven finite where that is possible; then the lines are named and written, and long sequences divided.

mod factors;
mod function;
mod joined;
mod lines;
mod names;
mod operations;
mod order;
mod program;
mod proven;
mod schedule;
mod scheduling;
mod sharing;
mod stretches;
mod translate;
mod value;

pub use function::Code;
pub use program::program;
pub use schedule::{Circular, Line, Schedule};
pub use scheduling::schedule;
pub use value::{Signed, Value, ValueId};
