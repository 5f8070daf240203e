//! The places of emitted items: on the statement that they come from, so that notes of rustc, links to the source and
//! editors lead there instead of to the whole macro call.

use proc_macro2::{Group, Span, TokenStream, TokenTree};

/// The place of a name, with the hygiene of the macro call.
pub(super) fn of(name: Span) -> Span {
    Span::call_site().located_at(name)
}

/// Puts the signs, braces and keywords of items on a place, down to a depth of groups. Names keep their own places.
pub(super) fn located(items: TokenStream, at: Span, depth: usize) -> TokenStream {
    let moved = items.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            let inner = if depth > 0 { located(group.stream(), at, depth - 1) } else { group.stream() };
            let mut moved = Group::new(group.delimiter(), inner);
            moved.set_span(at);
            TokenTree::Group(moved)
        }
        TokenTree::Ident(word) if is_keyword(&word.to_string()) => {
            let mut word = word;
            word.set_span(at);
            TokenTree::Ident(word)
        }
        TokenTree::Punct(mut sign) => {
            sign.set_span(at);
            TokenTree::Punct(sign)
        }
        name => name,
    });
    moved.collect()
}

/// True for the keywords that begin emitted items.
fn is_keyword(word: &str) -> bool {
    ["pub", "struct", "impl", "fn", "const", "for", "type", "use"].contains(&word)
}
