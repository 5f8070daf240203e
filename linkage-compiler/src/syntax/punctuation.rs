//! Parsers of `=` and of `;`.

use syn::Token;
use syn::parse::ParseStream;

use super::expression::Expressions;
use super::foreign;
use super::tokens::take;
use crate::diagnostics::Region;

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
