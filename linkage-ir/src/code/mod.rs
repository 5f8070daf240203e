//! Compiled code: the functions of a mechanism as the compiler lowers them. Printers write it, the interpreter runs it.
//!
//! A value refers to others of its function by their index, always to earlier ones: there are no cycles. One that a statement binds,
//! and an argument, has a [`Slot`](crate::Slot), which [`Value::Given`] reads; any other is computed at each place where it is used,
//! in the order in which emitted code computes it.

mod function;
mod names;
mod statement;
mod types;
mod value;

pub use function::{Access, Argument, Called, Code, Function, Passed, Readable, Returned};
pub use names::Names;
pub use statement::{Block, Pattern, Statement};
pub use types::{Type, TypeNames};
pub use value::{Callee, Given, Receiver, Signed, Value};
