//! The bounds of what is parsed at all.

use proc_macro2::{Span, TokenStream, TokenTree};

/// The largest nesting of parentheses; it bounds the recursion of the parser.
pub const DEEPEST_NESTING: usize = 64;

/// The largest number of tokens of an invocation; it bounds the time of parsing.
pub const LONGEST: usize = 100_000;

/// The largest number of letters of a name or a number; it bounds the time in which a number is read and two names are compared.
pub const LONGEST_WORD: usize = 256;

/// The first token that is nested too deep, too long or beyond the largest number of tokens, and its message.
pub(crate) fn excess(input: &TokenStream, longest: usize) -> Option<(Span, String)> {
    let mut levels = vec![input.clone().into_iter()];
    let mut count = 0;
    while let Some(level) = levels.last_mut() {
        match level.next() {
            None => drop(levels.pop()),
            // The braces of the mechanism are a level of their own.
            Some(token) if levels.len() > DEEPEST_NESTING + 1 => {
                let advice = format!("nested deeper than {DEEPEST_NESTING} levels; name the inner parts with `let`");
                return Some((token.span(), advice));
            }
            Some(token) if count == longest => {
                return Some((token.span(), format!("more than {longest} tokens; split the invocation")));
            }
            Some(token) if is_long(&token) => {
                let advice = format!("a name or a number has at most {LONGEST_WORD} letters");
                return Some((token.span(), advice));
            }
            Some(token) => {
                count += 1;
                if let TokenTree::Group(group) = token {
                    levels.push(group.stream().into_iter());
                }
            }
        }
    }
    None
}

/// True for a long name and a long number; a text may be long, as in a doc comment.
fn is_long(token: &TokenTree) -> bool {
    let text = match token {
        TokenTree::Ident(name) => name.to_string(),
        TokenTree::Literal(literal) => literal.to_string(),
        TokenTree::Group(_) | TokenTree::Punct(_) => return false,
    };
    let is_word =
        text.starts_with(|first: char| first.is_alphanumeric() || first == '_') && !text.ends_with(['"', '#']);
    is_word && text.chars().count() > LONGEST_WORD
}
