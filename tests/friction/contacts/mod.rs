//! Dry friction and stops against exact motions, and against integrations written by hand.

mod blocks;
mod errors;
mod law;
mod levers;
mod machines;
mod moving;
mod two_inputs;
