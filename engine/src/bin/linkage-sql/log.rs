//! The log on the standard error stream.

use log::{LevelFilter, Log, Metadata, Record};

/// The lines of this crate from a level on, and those of all others from warnings on.
struct Lines;

impl Log for Lines {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() <= LevelFilter::Warn || metadata.target().starts_with("linkage")
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            eprintln!("{}: {}", record.level().as_str().to_lowercase(), record.args());
        }
    }

    fn flush(&self) {}
}

/// Writes warnings and errors; with `verbose` also the begin and end of each partition.
pub fn start(verbose: bool) {
    log::set_max_level(if verbose { LevelFilter::Debug } else { LevelFilter::Warn });
    // It fails only if there is a log already.
    let _ = log::set_logger(&Lines);
}
