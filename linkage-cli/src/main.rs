//! The program `linkage`: what `linkage!` does, for mechanisms in files of their own and without a Rust project.
//!
//! Each command is a file of `commands/`. They share four things: a [`source`] is read within bounds, [`messages`] show its
//! mistakes, [`output`] writes a file next to the old one and renames it, and a [`failure`] becomes the exit code.

mod about;
mod aligned;
mod arguments;
mod columns;
mod commands;
mod curve;
mod ends;
mod failure;
mod figure;
mod followed;
mod interrupt;
mod listener;
mod live;
mod machine;
mod messages;
mod mistakes;
mod motion;
mod names;
mod one_input;
mod output;
mod page;
mod parameters;
mod picture;
mod position;
mod progress;
mod proved;
#[cfg(test)]
mod random_linkages;
mod reasons;
mod said;
mod scene;
mod solver;
mod source;
mod start;
mod symbols;
mod terminal;
mod tips;
mod unwound;
mod values;

use std::process::ExitCode;

use clap::Parser;

use arguments::Arguments;
use terminal::say;

fn main() -> ExitCode {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| {
        let words: Vec<String> = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
        let error = tips::with_tip(error, &words);
        if words.iter().any(|word| word.contains(char::is_control)) {
            say!("{}", error.render());
            std::process::exit(error.exit_code());
        }
        error.exit()
    });
    if let Err(error) = interrupt::install() {
        say!("interrupts are not noticed: {error}");
    }
    match commands::run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
