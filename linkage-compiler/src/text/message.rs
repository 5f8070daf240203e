//! A mistake in a text, as data.

use std::fmt::{self, Display};

use proc_macro2::{Span, TokenStream, TokenTree};

use crate::diagnostics::Diagnostics;

/// Hints of the macro that a text without Rust cannot follow.
const FOR_RUST: [&str; 3] = [
    "; declare a user function with `extern fn`",
    ": put the cases into a user function, `extern fn`",
    ": put cases into a user function, `extern fn`",
];

/// A mistake in a text. Messages are ordered by their places.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Message {
    /// The line of the marked tokens, from 1.
    pub line: usize,
    /// The column of their first character, from 1; each character counts as one, as in rustc's messages.
    pub column: usize,
    /// The number of characters that are marked in this line; marked tokens that go on in the next line end with this one.
    /// It is 0 if no tokens are marked: the text has none, or is too long.
    pub length: usize,
    /// The first line of the macro's message.
    pub text: String,
    /// The other lines of the macro's message: what can be written instead, or what there is to choose from. Most messages
    /// say this in their first line.
    pub help: Option<String>,
}

impl Message {
    /// A message that marks one line.
    pub(super) fn new((line, column): (usize, usize), length: usize, message: &str) -> Self {
        let (text, help) = match message.split_once('\n') {
            Some((first, rest)) => (first.to_owned(), Some(rest.to_owned())),
            None => (message.to_owned(), None),
        };
        Self { line, column, length, text, help }
    }
}

impl Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.text)
    }
}

impl std::error::Error for Message {}

/// The places of tokens in one text; they are asked for while its spans are valid.
pub(super) struct Places {
    /// The name of the text in `proc-macro2`.
    name: String,
    /// The number of characters of each line, without blanks at its end.
    lines: Vec<usize>,
    /// The last token.
    last: Span,
}

impl Places {
    /// The places of the tokens of a text; `None` if it has none.
    pub(super) fn new(text: &str, tokens: &TokenStream) -> Option<Self> {
        let last = match tokens.clone().into_iter().last()? {
            TokenTree::Group(group) => group.span_close(),
            other => other.span(),
        };
        let lines = text.split('\n').map(|line| line.trim_end().chars().count()).collect();
        Some(Self { name: last.file(), lines, last })
    }

    /// The messages of one stage.
    pub(super) fn messages(&self, diagnostics: &Diagnostics) -> Vec<Message> {
        let in_text = |message: String| FOR_RUST.iter().fold(message, |message, hint| message.replace(hint, ""));
        diagnostics.errors().iter().map(|error| self.message(error.span(), &in_text(error.to_string()))).collect()
    }

    /// A message on a token.
    pub(super) fn message(&self, at: Span, message: &str) -> Message {
        let (place, length) = self.region(at);
        Message::new(place, length, message)
    }

    /// The line and the column of a span, and the number of its characters in that line.
    fn region(&self, span: Span) -> ((usize, usize), usize) {
        // The end of the input is no token: there something is missing after the last one.
        let span = if span.file() == self.name { span } else { self.last };
        let (start, end) = (span.start(), span.end());
        let last = if start.line == end.line { end.column } else { self.of_line(start.line) };
        ((start.line, start.column + 1), last.saturating_sub(start.column))
    }

    fn of_line(&self, line: usize) -> usize {
        line.checked_sub(1).and_then(|index| self.lines.get(index)).copied().unwrap_or_default()
    }
}
