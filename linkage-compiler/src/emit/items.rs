//! Attributes of a mechanism that apply to all emitted items.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::Attribute;

/// Puts attributes before every item: `cfg` before all, lint levels before all but macro calls, which do not accept
/// them.
pub(super) fn bearing(items: TokenStream, everywhere: &[Attribute]) -> TokenStream {
    if everywhere.is_empty() {
        return items;
    }
    let (mut all, mut item) = (TokenStream::new(), Vec::new());
    let mut is_constant = None;
    let mut tokens = items.into_iter().peekable();
    while let Some(token) = tokens.next() {
        // An item begins after its attributes.
        if let TokenTree::Ident(word) = &token {
            is_constant.get_or_insert(word == "const");
        }
        let ends = match &token {
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace && is_constant != Some(true),
            _ => false,
        };
        item.push(token);
        if ends || tokens.peek().is_none() {
            let is_call = item.iter().any(|token| matches!(token, TokenTree::Punct(punct) if punct.as_char() == '!'));
            for attribute in everywhere.iter().filter(|attribute| !is_call || attribute.path().is_ident("cfg")) {
                attribute.to_tokens(&mut all);
            }
            all.extend(item.drain(..));
            is_constant = None;
        }
    }
    all
}
