//! The form of compiled linkages, which compiler, interpreter and runtime read: tables of the functions that they call, each
//! defined once, exact numbers, and with the feature `code` the compiled functions.
//!
//! [`ElementaryFunction`] are those of mathematics, which formulas call; [`Intrinsic`] those that compiled code calls and does
//! not define: of the runtime, of the scalar, and of emitted types. A row of a table is what every reader of the form needs to
//! know. What only one needs stays there: derivatives in the compiler, values in the runtime.
//!
//! [`document`] has the records of derivations: what documents print, in two storages.
//!
//! [`Ratio`] computes exactly: [`Number`]s, which are the constants of formulas, and factors of angles in certified motions.
#![no_std]

#[cfg(feature = "code")]
extern crate alloc;

#[cfg(feature = "code")]
pub mod code;
pub mod document;
mod elementary;
#[cfg(feature = "code")]
mod ids;
mod intrinsic;
mod number;
mod operations;
mod ratio;

pub use elementary::ElementaryFunction;
#[cfg(feature = "code")]
pub use ids::{ExternalId, FunctionId, Name, Slot, ValueId};
pub use intrinsic::{CheckKind, Constant, Entry, Finite, Form, InLane, Intrinsic, LaneResult, Meaning, Role, Row};
pub use number::Number;
pub use operations::Operations;
pub use ratio::Ratio;
