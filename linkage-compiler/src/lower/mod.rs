//! Lowering: from planned functions to typed code.
//!
//! The formulas of a kernel become values with ids ([`Value`]), and each pass changes or reads these. In order:
//!
//! 1. `translate`: nodes of the graph become values; signs move to sums and results;
//! 2. `sharing`: common pairs of operands are computed once;
//! 3. `joined`: what is used once is written where it is used;
//! 4. `factors`, `terms`, `order`: the order of factors, terms and lines ([`Schedule`]);
//! 5. `operations`, `rounding`: a kernel's operations are counted, and its largest rounding errors found;
//! 6. `lines`, `signs`, `sources`, `chords`, `modes`: lines become statements, and signs return to where they
//!    are written;
//! 7. `proven`: results that are finite if the checks pass; `planned`, `checks`: what the plan has around the kernel;
//! 8. `stored`, `reads`, `stretches`, `unneeded`: the places of stores, reads and long sequences, and what nothing needs;
//!    all ask `uses` which values a statement reads;
//! 9. `calls`, `counts`: operations are counted, with those of the functions that it calls;
//! 10. `naming`: names, the only pass that knows them;
//! 11. `resolve`: bound values get slots, and the code is finished: [`linkage_ir::code`].
//!
//! A reference to something that does not exist is an error of construction ([`Dangling`]): finished code has none.

mod calls;
mod checks;
mod chords;
mod code;
mod context;
mod counts;
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
mod resolve;
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
mod turn;
mod unneeded;
mod uses;
mod value;
mod values;
mod writer;

pub use function::Dangling;
pub use program::{Bounds, program};
pub use rounding::Bound;
pub use schedule::{Circular, Line, Schedule};
pub use scheduling::schedule;
pub use turn::parts_of_pi;
pub use value::{Leaf, Value};
