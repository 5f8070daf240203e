//! The reason why a question has no answer.

use std::fmt::Display;

use serde::Serialize;

/// The reason why a question has no answer, in one sentence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Refusal {
    /// The sentence.
    pub why: String,
}

impl Refusal {
    pub(crate) fn new(why: impl Display) -> Self {
        Self { why: why.to_string() }
    }
}
