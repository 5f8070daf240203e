//! The log on the standard error stream.

use std::fmt::Display;
use std::io::Write;

use log::{LevelFilter, Log, Metadata, Record};

/// The lines of this crate, and those of all others from a level on.
struct Lines {
    others: LevelFilter,
}

impl Log for Lines {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() <= self.others || metadata.target().starts_with("linkage")
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            say(format_args!("{}: {}", record.level().as_str().to_lowercase(), record.args()));
        }
    }

    fn flush(&self) {}
}

/// Writes a line to the standard error stream, if that has a reader.
pub fn say(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// The log of a client: Ballista would write the errors that it returns.
pub fn of_client() {
    start(&Lines { others: LevelFilter::Off }, LevelFilter::Warn);
}

/// The log of a scheduler or an executor; with `verbose` the begin and end of each partition too.
pub fn of_server(verbose: bool) {
    start(&Lines { others: LevelFilter::Warn }, if verbose { LevelFilter::Debug } else { LevelFilter::Warn });
}

fn start(lines: &'static Lines, level: LevelFilter) {
    log::set_max_level(level);
    // It fails only if there is a log already.
    let _ = log::set_logger(lines);
}
