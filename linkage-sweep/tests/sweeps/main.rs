//! Sweeps: plans, rows, reducers, files and threads.

mod chunks;
mod common;
mod errors;
mod files;
mod front;
mod motion;
mod reducers;
mod rows;
mod samples;
mod threads;
