//! The commands, each a file.

mod animate;
mod certify;
mod check;
mod circuits;
mod compiled;
mod completions;
mod draw;
mod equilibrium;
mod fpcore;
mod limits;
mod list;
mod names;
mod new;
mod report;
mod rust;
mod serve;
mod sheet;
mod simulate;
mod summary;
mod table;

pub use draw::svg_or_message;

use crate::arguments::Command;
use crate::failure::Failure;

pub fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::New(arguments) => new::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Names(arguments) => names::run(&arguments),
        Command::Sheet(arguments) => sheet::run(&arguments),
        Command::Table(arguments) => table::run(&arguments),
        Command::Draw(arguments) => draw::run(&arguments),
        Command::Animate(arguments) => animate::run(&arguments),
        Command::Limits(arguments) => limits::run(&arguments),
        Command::Circuits(arguments) => circuits::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Equilibrium(arguments) => equilibrium::run(&arguments),
        Command::Certify(arguments) => certify::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Rust(arguments) => rust::run(&arguments),
        Command::Serve(arguments) => serve::run(&arguments),
        Command::Fpcore(arguments) => fpcore::run(&arguments),
        Command::Completions { shell } => completions::run(shell),
    }
}
