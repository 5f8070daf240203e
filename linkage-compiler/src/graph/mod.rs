//! The expression graph: hash-consed nodes with exact constants and n-ary sums and products.
//!
//! Equal expressions are one node, so that derivatives share common subexpressions. Children precede their parents,
//! hence every traversal is a loop over ascending ids, without recursion.

mod arena;
mod arithmetic;
mod circular;
mod differentiate;
mod exact;
mod external;
mod interpret;
mod node;
mod operations;
mod print;
mod replace;
mod sweep;

pub use arena::Graph;
pub use linkage_ir::{ElementaryFunction as Function, Number};
pub use node::{Condition, External, ExternalId, Fault, LARGEST_EXPONENT, Node, NodeId, SymbolId};
pub use operations::{Exception, OPERATIONS, Operation, Place, operation, written};
pub use print::Texts;
