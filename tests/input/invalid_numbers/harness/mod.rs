//! The calls: their arguments, the checks of their results, and their outcomes.

mod algorithms;
mod draw;
mod finite;
mod tally;

pub use algorithms::{driven, integrations, mechanism, positions, scene};
pub use draw::{Draw, Pool, Source};
pub use finite::Finite;
pub use linkage::nalgebra::SVector;
pub use tally::{Tally, evaluated, listen};

/// The calls of one mechanism or one scene with the arguments of one trial.
pub type Subject = fn(&mut Tally, &mut Source);
