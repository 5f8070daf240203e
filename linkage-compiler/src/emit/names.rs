//! Identifiers and string literals as tokens.

use proc_macro2::{Ident, Literal, Span};

use crate::syntax::identifier;

pub(super) fn ident(name: &str) -> Ident {
    identifier(name, Span::call_site())
}

/// A text as a string literal: raw if it contains characters that need an escape.
pub(super) fn quoted(text: &str) -> String {
    match (text.contains('"'), text.contains('\\')) {
        (false, false) => format!("\"{text}\""),
        (false, true) => format!("r\"{text}\""),
        (true, _) if text.contains("\"#") => format!("{text:?}"),
        (true, _) => format!("r#\"{text}\"#"),
    }
}

/// The text of a doc comment as a raw literal, as rustc itself represents `///`.
pub(super) fn comment(text: &str) -> Literal {
    let plain = !text.contains('"');
    let raw = plain.then(|| format!("r\"{text}\"").parse().ok()).flatten();
    raw.unwrap_or_else(|| string(text))
}

/// A string literal.
pub(super) fn string(text: &str) -> Literal {
    quoted(text).parse().unwrap_or_else(|_| Literal::string(text))
}
