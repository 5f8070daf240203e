//! True if every number of a result is finite, as far as `Debug` writes it.

use std::fmt::Debug;

/// True if a value has no number that is infinite or none.
pub fn is_finite(value: &impl Debug) -> bool {
    all_finite(&format!("{value:?}"))
}

/// True if a text of `Debug` has no `inf` and no `NaN`, outside of texts in quotes and of errors.
pub fn all_finite(text: &str) -> bool {
    let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_';
    let (mut rest, mut before) = (text, ' ');
    while let Some(letter) = rest.chars().next() {
        let is_begin = !is_letter(before);
        let word = rest.find(|letter| !is_letter(letter)).unwrap_or(rest.len());
        match letter {
            '"' => rest = after_quotes(&rest[1..]),
            _ if is_begin && matches!(&rest[..word], "inf" | "NaN") => return false,
            // An error states numbers as they are.
            _ if is_begin && rest.starts_with("Err(") => rest = after_brackets(&rest[3..]),
            _ => rest = &rest[letter.len_utf8()..],
        }
        before = letter;
    }
    true
}

/// The text after that in quotes.
fn after_quotes(text: &str) -> &str {
    let mut is_escaped = false;
    let end = text.find(|letter| {
        let is_end = letter == '"' && !is_escaped;
        is_escaped = letter == '\\' && !is_escaped;
        is_end
    });
    end.map_or("", |end| &text[end + 1..])
}

/// The text after that in brackets, with which it begins.
fn after_brackets(text: &str) -> &str {
    let (mut rest, mut depth) = (text, 0);
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        match letter {
            '"' => rest = after_quotes(rest),
            '(' => depth += 1,
            ')' if depth == 1 => return rest,
            ')' => depth -= 1,
            _ => {}
        }
    }
    rest
}
