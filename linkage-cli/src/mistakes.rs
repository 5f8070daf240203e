//! A text and its mistakes.

use linkage_compiler::text::Message;

/// A text and the name of its file.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub text: String,
}

/// A mistake in a text, or of the file itself, which has no place.
#[derive(Debug, Clone)]
pub enum Mistake {
    Text(Message),
    File(String),
}

/// The mistakes of one text, in the order of their places.
#[derive(Debug, Clone)]
pub struct Mistakes {
    pub source: Source,
    pub all: Vec<Mistake>,
}

impl Mistakes {
    /// The mistakes that the compiler found.
    pub fn of(source: &Source, messages: Vec<Message>) -> Self {
        Self { source: source.clone(), all: messages.into_iter().map(Mistake::Text).collect() }
    }
}
