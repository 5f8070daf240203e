//! Parsers of a name, of `=` and of `;`.

use proc_macro2::{Ident, TokenTree};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;

use super::expression::Expressions;
use super::foreign;
use crate::diagnostics::Region;

pub(super) fn name(stream: ParseStream) -> syn::Result<Ident> {
    let is_free = stream.peek(syn::Ident);
    if stream.peek(Token![_]) {
        return Err(stream.error("`_` is not a name: write a name, which may begin with `_`"));
    }
    let name = stream.call(Ident::parse_any).map_err(|error| syn::Error::new(error.span(), "expected a name"))?;
    let text = name.to_string();
    if !is_free || text.starts_with("r#") {
        return Err(syn::Error::new(name.span(), format!("`{text}` is a Rust keyword: choose another name")));
    }
    Ok(name)
}

/// The signs that other languages write for `=`.
const EQUALITY: [&str; 9] = ["==", "=>", ":=", "<-", "->", "<=", ">=", ":", "~"];

/// Parses `=`. Another sign is reported and read as `=`, and so is a missing one before an expression.
pub(super) fn equals(stream: ParseStream, expressions: &mut Expressions, form: &str) -> syn::Result<()> {
    if let Some((sign, region)) = EQUALITY.iter().find_map(|sign| Some((*sign, take(stream, sign)?))) {
        let message = match sign {
            "==" => "write one `=`".to_owned(),
            _ => format!("expected `=`, found `{sign}`: write `{form}`"),
        };
        expressions.slip(region, message);
        return Ok(());
    }
    let found = stream.span();
    if stream.parse::<Option<Token![=]>>()?.is_some() {
        return Ok(());
    }
    if !stream.peek(Token![;]) && foreign::begins_factor(stream) {
        expressions.slip(found, format!("expected `=` before this: write `{form}`"));
        return Ok(());
    }
    if let Some(error) = foreign::sign(stream) {
        return Err(error);
    }
    Err(syn::Error::new(found, format!("expected `=`: write `{form}`")))
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

/// Parses `;`. If it is missing at the end of the braces, the error is on the last token of the statement.
pub(super) fn end(stream: ParseStream, last: Option<Region>) -> syn::Result<()> {
    if stream.is_empty() {
        let span = last.map_or_else(|| stream.span(), |region| region.last);
        return Err(syn::Error::new(span, "expected `;` after this"));
    }
    let found = stream.span();
    if stream.parse::<Option<Token![;]>>()?.is_some() {
        return Ok(());
    }
    Err(foreign::sign(stream).unwrap_or_else(|| syn::Error::new(found, "expected `;` before this")))
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
