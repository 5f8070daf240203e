//! Guesses for the stub of a mechanism with mistakes. It has the names and the types of the mechanism that is meant, so
//! that the rest of the program is no second mistake. All guesses are made here; resolution, program and emission
//! read them.

mod names;
mod scenes;
mod solution;

pub(super) use names::{complete, without_idle};
pub(super) use scenes::{completed, drive, driven, driver};
pub use solution::{Guess, GuessedGroup};
