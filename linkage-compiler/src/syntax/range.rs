//! Ranges of coordinates and outputs: `in least..most`, both ends included; either may be missing.

use proc_macro2::{Ident, TokenTree};
use syn::Token;
use syn::parse::ParseStream;

use super::expression::Expressions;
use super::kind::{Range, at_keyword};
use super::precedence;
use super::tokens::{take, word};
use crate::diagnostics::Region;

/// The statements with ranges, for messages.
const WITH_RANGES: &str = "a range follows the name of an `input`, an `unknown`, a `coordinate` or an `output`";

/// Parses `in least..most`, if it comes next.
pub(super) fn range(stream: ParseStream, expressions: &mut Expressions, name: &Ident) -> syn::Result<Option<Range>> {
    if !word(stream, "in") {
        return Ok(None);
    }
    let start = Region::from(stream.span());
    let form = format!("expected a range: write `{name} in least..most`, where one end may be missing");
    let is_missing = |stream: ParseStream| {
        let ends = stream.is_empty() || stream.peek(Token![;]) || stream.peek(Token![,]) || stream.peek(Token![=]);
        ends || at_keyword(stream)
    };
    if is_missing(stream) {
        return Err(syn::Error::new(stream.span(), form));
    }
    let least = (!stream.peek(Token![..])).then(|| precedence::parse(stream, expressions)).transpose()?;
    let found = Region::from(stream.span());
    let mut dots = found;
    if stream.peek(Token![..=]) {
        let region = take(stream, "..=").unwrap_or(found);
        expressions.slip(region, "write `..`: both ends of a range belong to it");
    } else if let Some(region) = take(stream, "..") {
        dots = region;
    } else {
        let region = least.map_or(found, |least| expressions.region(least));
        return Err(syn::Error::new_spanned(region, form));
    }
    // A name after a number is another coordinate: a comma is missing.
    let is_alone = stream.peek(syn::Lit) && stream.peek2(syn::Ident);
    let most = match (is_missing(stream), is_alone) {
        (true, _) => None,
        (false, true) => Some(precedence::postfix(stream, expressions)?),
        (false, false) => Some(precedence::parse(stream, expressions)?),
    };
    if least.is_none() && most.is_none() {
        expressions
            .slip(dots, format!("this range has no end: write `{name} in least..most`, where one may be missing"));
        return Ok(None);
    }
    let region = most.or(least).map_or(start, |last| start.to(expressions.region(last)));
    Ok(Some(Range { ends: [least, most], region }))
}

/// Reports a range after a name that has none.
pub(super) fn no_range(stream: ParseStream, expressions: &mut Expressions, of: &str, name: &Ident) -> syn::Result<()> {
    if !stream.peek(Token![in]) {
        return Ok(());
    }
    let mut region = Region::from(stream.span());
    while !(stream.is_empty() || [",", ";", "="].iter().any(|sign| take(&stream.fork(), sign).is_some())) {
        region = region.to(stream.parse::<TokenTree>()?.span().into());
    }
    expressions.slip(region, format!("{of} has no range here: write `{name}`\n{WITH_RANGES}"));
    Ok(())
}
