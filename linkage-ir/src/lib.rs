//! The functions that compiled linkages call, each defined once for the compiler, the interpreter and the runtime; and exact
//! ratios.
//!
//! [`ElementaryFunction`] are those of mathematics, which formulas call; [`Intrinsic`] those that compiled code calls and does
//! not define: of the runtime, of the scalar, and of emitted types. A row of a table is what every reader of the form needs to
//! know. What only one needs stays there: derivatives in the compiler, values in the runtime.
//!
//! [`Ratio`] computes exactly: [`Number`]s, which are the constants of formulas, and factors of angles in certified motions.
#![no_std]

mod elementary;
mod intrinsic;
mod number;
mod operations;
mod ratio;

pub use elementary::ElementaryFunction;
pub use intrinsic::{CheckKind, Constant, Entry, Finite, Form, InLane, Intrinsic, LaneResult, Meaning, Role, Row};
pub use number::Number;
pub use operations::Operations;
pub use ratio::Ratio;
