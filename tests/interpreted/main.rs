//! Mechanisms at run time: the bits and the errors of the emitted code.

mod algorithms;
#[path = "../at_run_time.rs"]
mod at_run_time;
mod classics;
mod columns;
mod drawn;
mod gaps;
mod mutants;
mod printed;
mod same_bits;
mod turns;
mod which_motion;
mod written;
