//! Lines on the standard output.

use std::fmt::Display;
use std::io::{self, Write};

use crate::EngineError;

/// Prints a line. If its reader has gone, as `head` does, the process ends.
///
/// # Errors
/// [`EngineError::Sweep`], if the line cannot be written for another reason.
pub fn print(line: impl Display) -> Result<(), EngineError> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{line}").and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => std::process::exit(0),
        Err(source) => {
            Err(linkage_sweep_arrow::Error::Io { path: Some("the standard output".into()), attempt: "write", source }
                .into())
        }
    }
}
