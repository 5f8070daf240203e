//! Failures of tasks, on their way from an executor to the client.

use std::error::Error;
use std::fmt;
use std::io;

use datafusion::error::DataFusionError;

use super::ATTEMPTS;
use crate::EngineError;

/// The reason why a task failed.
///
/// Ballista hands on texts: the debug output of an error, in the debug output of a string. Marks around the reason tell
/// where it is in them.
pub struct Failure(String);

impl Failure {
    const BEGIN: char = '\u{ab}';
    const END: char = '\u{bb}';

    /// A failure after which the job fails.
    pub fn of_job(reason: String) -> DataFusionError {
        DataFusionError::External(Box::new(Self(reason)))
    }

    /// The failure of a chunk as an error of input and output, the only kind after which Ballista runs a task again.
    /// Other errors remain as they are.
    pub fn of_chunk(error: DataFusionError) -> DataFusionError {
        match error.find_root() {
            DataFusionError::External(inner) if matches!(inner.downcast_ref(), Some(EngineError::Chunk { .. })) => {
                DataFusionError::IoError(io::Error::other(Self(inner.to_string())))
            }
            _ => error,
        }
    }

    /// The reason in the text of a failed job, or the whole text.
    pub fn reason(text: &str) -> String {
        let marked = text.split_once(Self::BEGIN).and_then(|(_, text)| text.rsplit_once(Self::END));
        let Some((escaped, rest)) = marked else { return text.to_owned() };
        let reason = serde_json::from_str(&format!("\"{escaped}\"")).unwrap_or_else(|_| escaped.to_owned());
        // Errors of a job are not repeated.
        let is_repeated = text.contains(&format!("failed {ATTEMPTS} times")) && !rest.is_empty();
        if is_repeated { format!("{reason}; the partition failed {ATTEMPTS} times") } else { reason }
    }
}

impl fmt::Debug for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", Self::BEGIN, self.0, Self::END)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

impl Error for Failure {}
