//! Lowering: from graph nodes to straight-line code with common subexpression elimination and one sine-cosine pair for
//! each angle.
//!
//! The formulas of a kernel are translated to values (`translate`), common pairs of operands are eliminated
//! (`sharing`), single uses inlined again (`joined`), factors and lines ordered ([`schedule`]). An analysis finds
//! results that are always finite (`proven`). Then lines get names (`names`) and become statements (`lines`). Results of
//! long kernels are stored as they become known (`stored`), and long sequences are divided into blocks (`stretches`).

mod chords;
mod factors;
mod finished;
mod formulas;
mod function;
mod joined;
mod lines;
mod modes;
mod names;
mod operations;
mod order;
mod program;
mod proven;
mod rounding;
mod schedule;
mod scheduling;
mod sharing;
mod stored;
mod stretches;
mod terms;
mod translate;
mod value;
mod works;

pub use function::Code;
pub use program::program;
pub use rounding::{Bound, Roundings};
pub use schedule::{Circular, Line, Schedule};
pub use scheduling::schedule;
pub use value::{Signed, Value, ValueId};
