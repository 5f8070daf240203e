//! Lowering: from graph nodes to straight-line code with common subexpression elimination and one sine-cosine pair for
//! each angle.
//!
//! The formulas of a kernel are translated to values (`translate`), common pairs of operands are eliminated
//! (`sharing`), single uses inlined again (`joined`), factors and lines ordered ([`schedule`]). An analysis finds
//! results that are always finite (`proven`). Then lines get names (`names`) and become statements (`lines`). Results of
//! long kernels are stored as they become known (`stored`), and long sequences are divided into blocks (`stretches`).

mod checks;
mod chords;
mod code;
mod factors;
mod function;
mod joined;
mod lines;
mod modes;
mod naming;
mod operations;
mod order;
mod planned;
mod program;
mod proven;
mod reads;
mod rounding;
mod schedule;
mod scheduling;
mod sharing;
mod signs;
mod sources;
mod stored;
mod stretches;
mod terms;
mod translate;
mod unneeded;
mod uses;
mod value;
mod values;
mod works;
mod writer;

pub use code::{Block, Callee, Code, Pattern, Returned, Statement};
pub use function::Dangling;
pub use program::program;
pub use rounding::Bound;
pub use schedule::{Circular, Line, Schedule};
pub use scheduling::schedule;
pub use value::{Signed, Value, ValueId};
