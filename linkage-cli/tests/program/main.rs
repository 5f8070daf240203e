//! The program from outside: each command, its exit code and its messages; bad input; interrupts.

mod bad_input;
mod certificates;
mod commands;
mod folder;
mod interrupts;
mod motions;
mod numbers;
mod pages;
mod pictures;
mod reasons;
mod reports;
mod simulations;
mod tables;
mod turns;
mod units;
mod which_motion;
mod written_names;
