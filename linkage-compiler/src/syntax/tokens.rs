//! Parsers of a name, a sign and a word.

use proc_macro2::{Ident, TokenTree};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;

use super::identifier::{KEYWORD_AS_NAME, can_be_name, is_keyword, plain};
use crate::diagnostics::Region;

pub(super) fn name(stream: ParseStream) -> syn::Result<Ident> {
    if stream.peek(Token![_]) {
        return Err(stream.error("`_` is not a name: write a name, which may begin with `_`"));
    }
    let name = stream.call(Ident::parse_any).map_err(|error| syn::Error::new(error.span(), "expected a name"))?;
    let text = name.to_string();
    if text == "mut" {
        return Err(syn::Error::new(name.span(), "a name has no `mut`: leave it out"));
    }
    if is_keyword(&text) || !can_be_name(&text) {
        let advice = if can_be_name(&text) { format!(", or write `r#{text}`") } else { String::new() };
        return Err(syn::Error::new(name.span(), format!("`{text}` {KEYWORD_AS_NAME}{advice}")));
    }
    Ok(plain(name))
}

/// Takes a sign of one or two characters, if it comes next.
pub(super) fn take(stream: ParseStream, sign: &str) -> Option<Region> {
    let ahead = stream.fork();
    let mut region: Option<Region> = None;
    for character in sign.chars() {
        match ahead.parse::<TokenTree>() {
            Ok(TokenTree::Punct(punct)) if punct.as_char() == character => {
                let here = Region::from(punct.span());
                region = Some(region.map_or(here, |region| region.to(here)));
            }
            _ => return None,
        }
    }
    syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
    region
}

/// Takes a word, if it comes next.
pub(super) fn word(stream: ParseStream, word: &str) -> bool {
    let ahead = stream.fork();
    let comes = ahead.call(Ident::parse_any).is_ok_and(|found| found == word);
    if comes {
        syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
    }
    comes
}
