//! Failures, and the exit codes that they become.

use std::fmt::Display;
use std::io::{self, ErrorKind};
use std::process::ExitCode;

use linkage_report::lend::Unsound;

use crate::mistakes::Mistakes;
use crate::terminal::printable;

/// The exit code of wrong arguments, that of clap.
const ARGUMENTS: u8 = 2;

/// The end of a command without success.
#[derive(Debug)]
pub enum Failure {
    /// Mistakes in texts.
    Mistakes(Vec<Mistakes>),
    /// Mistakes in texts, which are reported.
    Reported,
    /// An argument is a name that the text does not have.
    Argument(String),
    /// A file cannot be written, or something else outside of the text.
    Outside(String),
    /// The reader of the output went away, as `head` does.
    NotRead,
}

impl Failure {
    /// The failure of writing to standard output.
    pub fn of_standard_output(error: &io::Error) -> Self {
        match error.kind() {
            ErrorKind::BrokenPipe => Self::NotRead,
            _ => Self::Outside(format!("standard output cannot be written: {error}")),
        }
    }

    /// Prints what there is to say, and returns the exit code.
    pub fn report(self) -> ExitCode {
        match self {
            Self::Mistakes(all) => {
                all.iter().for_each(|mistakes| anstream::eprint!("{}", mistakes.to_text()));
                ExitCode::FAILURE
            }
            Self::Reported => ExitCode::FAILURE,
            Self::Argument(message) => {
                error(message);
                ExitCode::from(ARGUMENTS)
            }
            Self::Outside(message) => {
                error(message);
                ExitCode::FAILURE
            }
            Self::NotRead => ExitCode::SUCCESS,
        }
    }
}

impl From<Mistakes> for Failure {
    fn from(mistakes: Mistakes) -> Self {
        Self::Mistakes(vec![mistakes])
    }
}

/// The compiler makes sound documents.
impl From<Unsound> for Failure {
    fn from(error: Unsound) -> Self {
        Self::Outside(error.to_string())
    }
}

/// Prints a message as clap does.
fn error(message: impl Display) {
    let style = anstyle::AnsiColor::Red.on_default().bold();
    anstream::eprintln!("{style}error:{style:#} {}", printable(&message.to_string()));
}
