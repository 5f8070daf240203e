//! Mechanisms at run time: the bits and the errors of the emitted code.

mod algorithms;
mod classics;
mod columns;
mod drawn;
mod mutants;
mod printed;
mod same_bits;
mod written;
