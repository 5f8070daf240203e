//! Tapes: the operations of a function without branches in a row, on numbers of several lanes side by side, so that reading
//! an operation costs little of what it computes.
//!
//! A tape is recorded: the machine runs the function once with numbers that stand for registers. What depends on constants
//! alone is computed then, and what nothing needs is left out.

mod instruction;
mod registers;
mod run;
mod traced;

pub(crate) use instruction::{Binary, Chord, Ternary, Test, Unary};
pub(crate) use registers::recorded;
pub(crate) use run::Block;
pub(crate) use traced::{Flag, Recorder, Traced};

use instruction::Instruction;

/// The number of lanes of a block: enough that an operation costs more than to read it, few enough that the registers of
/// a mechanism stay in the fastest cache.
pub(crate) const WIDTH: usize = 64;

/// A recorded function.
#[derive(Debug, Clone)]
pub(crate) struct Tape {
    instructions: Vec<Instruction>,
    /// The registers of numbers: the given columns, the constants, then the others.
    numbers: usize,
    flags: usize,
    /// The registers of the given columns that are read, with their places.
    given: Vec<(usize, u32)>,
    constants: Vec<(f64, u32)>,
    /// The found columns that are wanted.
    found: Vec<Traced>,
    /// True in the lanes whose results are those of the function for one position.
    accepted: Flag,
}
