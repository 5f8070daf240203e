//! Parsers of a name, of `=` and of `;`.

use proc_macro2::Ident;
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::ParseStream;

use crate::diagnostics::Region;

pub(super) fn name(stream: ParseStream) -> syn::Result<Ident> {
    let is_free = stream.peek(syn::Ident);
    let name = stream.call(Ident::parse_any).map_err(|error| syn::Error::new(error.span(), "expected a name"))?;
    let text = name.to_string();
    if !is_free || text.starts_with("r#") {
        return Err(syn::Error::new(name.span(), format!("`{text}` is a Rust keyword; choose another name")));
    }
    Ok(name)
}

pub(super) fn equals(stream: ParseStream) -> syn::Result<()> {
    let found = stream.span();
    stream.parse::<Token![=]>().map(drop).map_err(|_| syn::Error::new(found, "expected `=`"))
}

/// Parses `;`. If it is missing at the end of the braces, the error is on the last token of the statement.
pub(super) fn end(stream: ParseStream, last: Option<Region>) -> syn::Result<()> {
    if stream.is_empty() {
        let span = last.map_or_else(|| stream.span(), |region| region.last);
        return Err(syn::Error::new(span, "expected `;` after this"));
    }
    let found = stream.span();
    stream.parse::<Token![;]>().map(drop).map_err(|_| syn::Error::new(found, "expected `;` before this"))
}
