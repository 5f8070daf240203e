//! Keywords of Rust as names: the user writes `r#type`, the name is `type`, and the emitted identifier `r#type` again.

use proc_macro2::{Ident, Span};

/// The keywords of Rust 2024.
const OF_RUST: [&str; 53] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro",
    "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super",
    "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield", "_",
];

/// The message of a keyword as a name, after the keyword.
pub(crate) const KEYWORD_AS_NAME: &str = "is a Rust keyword: choose another name";

/// Words that Rust does not take as names, not even as `r#self`.
const PARTS_OF_PATHS: [&str; 5] = ["self", "Self", "super", "crate", "_"];

pub(crate) fn is_keyword(word: &str) -> bool {
    OF_RUST.contains(&word)
}

/// True if a word can be a name, if need be as `r#type`.
pub(crate) fn can_be_name(word: &str) -> bool {
    !PARTS_OF_PATHS.contains(&word) && !word.starts_with('$')
}

/// A name as an identifier: `type` as `r#type`.
pub(crate) fn identifier(name: &str, place: Span) -> Ident {
    if is_keyword(name) && can_be_name(name) { Ident::new_raw(name, place) } else { Ident::new(name, place) }
}

/// A name without the `r#` of `r#type`, which emitted identifiers have.
pub(super) fn plain(name: Ident) -> Ident {
    match name.to_string().strip_prefix("r#") {
        Some(text) => Ident::new(text, name.span()),
        None => name,
    }
}
