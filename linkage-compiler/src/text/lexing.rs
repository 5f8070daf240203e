//! Texts that are no tokens: brackets without their counterparts, texts in quotation marks, other characters.

use proc_macro2::{LexError, TokenStream};

use super::message::Message;

/// Characters that are meant as others, and what is written for them.
const MEANT: [(&str, &str); 13] = [
    ("−–—‐", "-"),
    ("×·⋅∙", "*"),
    ("÷∕⁄", "/"),
    ("°", "deg"),
    ("²", "^2"),
    ("³", "^3"),
    ("½", "1/2"),
    ("√", "sqrt(…)"),
    ("，", ","),
    ("；", ";"),
    ("（", "("),
    ("）", ")"),
    ("′″´`", "another name"),
];

/// The tokens of a text.
///
/// # Errors
/// The first character that begins no token, as a message.
pub(super) fn tokens(text: &str) -> Result<TokenStream, Message> {
    text.parse().map_err(|error| explained(text, &error))
}

fn explained(text: &str, error: &LexError) -> Message {
    let (at, place) = offset(error);
    let rest = text.get(at..).unwrap_or_default();
    let of_one = |message: &str| Message::new(place, 1, message);
    let Some(first) = rest.chars().next() else { return of_one("the text ends too early") };
    match first {
        '(' | '[' | '{' => of_one(&format!("this `{first}` is never closed")),
        ')' | ']' | '}' => of_one(&unopened(text.get(..at).unwrap_or_default(), first)),
        '\'' => of_one("`'` is no part of a name: a name has letters, digits and `_`"),
        '/' => Message::new(place, 2, "this comment has no end: write `*/`, or begin each of its lines with `//`"),
        '"' | 'r' | 'b' | 'c' => {
            of_one("a text in quotation marks is wrong or has no end: outside of doc comments the language has none")
        }
        '0'..='9' => {
            let number: String = rest.chars().take_while(|one| one.is_alphanumeric() || "_.".contains(*one)).collect();
            Message::new(place, number.chars().count(), &format!("`{number}` is not a number"))
        }
        _ => {
            let meant = MEANT.iter().find(|(characters, _)| characters.contains(first));
            let help = meant.map_or_else(String::new, |(_, instead)| match instead.contains(' ') {
                true => format!("\nwrite {instead}"),
                false => format!("\nwrite `{instead}`"),
            });
            let code = u32::from(first);
            of_one(&format!("`{}` (U+{code:04X}) is no character of the language{help}", first.escape_debug()))
        }
    }
}

/// The message of a closing bracket that no bracket or another one precedes.
fn unopened(before: &str, close: char) -> String {
    // All before it is tokens, or a bracket is open.
    match before.parse::<TokenStream>() {
        Ok(_) => format!("this `{close}` closes nothing"),
        Err(error) => {
            let (at, (line, column)) = offset(&error);
            let open = before.get(at..).and_then(|rest| rest.chars().next()).unwrap_or('(');
            format!("this `{close}` does not close `{open}` in line {line}, column {column}")
        }
    }
}

/// The place of an error: in bytes, and as line and column.
fn offset(error: &LexError) -> (usize, (usize, usize)) {
    let span = error.span();
    let start = span.start();
    (span.byte_range().start, (start.line.max(1), start.column + 1))
}
