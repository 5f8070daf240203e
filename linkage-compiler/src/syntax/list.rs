//! Lists of names: parameters, coordinates, keywords of `derive`.

use proc_macro2::{Delimiter, Ident, TokenTree};
use syn::Token;
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};

use super::expression::{ExpressionId, Expressions};
use super::kind::{Declared, at_keyword, at_word};
use super::precedence;
use super::punctuation::equals;
use super::range::{no_range, range};
use super::scene::{EFFECTS, PROPERTIES};
use super::tokens::{name, take};
use crate::diagnostics::Region;

/// Parses `a = 1, b`.
pub(super) fn parameters(
    stream: ParseStream,
    expressions: &mut Expressions,
) -> syn::Result<Vec<(Ident, Option<ExpressionId>)>> {
    listed(stream, expressions, &|stream, expressions| {
        let name = name(stream)?;
        skip_type(stream, expressions, "a parameter", &name)?;
        no_range(stream, expressions, "a parameter", &name)?;
        let has_value = !stream.is_empty() && !stream.peek(Token![,]) && !stream.peek(Token![;]);
        let default = (has_value && !stream.peek(syn::Ident)).then(|| {
            equals(stream, expressions, &format!("{name} = …"))?;
            precedence::parse(stream, expressions)
        });
        Ok((name, default.transpose()?))
    })
}

/// Parses `a, b`; a value is reported.
pub(super) fn names(stream: ParseStream, expressions: &mut Expressions, of: &str) -> syn::Result<Vec<Ident>> {
    listed(stream, expressions, &|stream, expressions| {
        let name = name(stream)?;
        skip_type(stream, expressions, &format!("`{of}`"), &name)?;
        no_range(stream, expressions, &format!("`{of}`"), &name)?;
        no_value(stream, expressions, of, &name)?;
        Ok(name)
    })
}

/// Parses `s in 0..1, phi`; a value is reported.
pub(super) fn declared(stream: ParseStream, expressions: &mut Expressions, of: &str) -> syn::Result<Vec<Declared>> {
    listed(stream, expressions, &|stream, expressions| {
        let name = name(stream)?;
        skip_type(stream, expressions, &format!("`{of}`"), &name)?;
        let range = range(stream, expressions, &name)?;
        no_value(stream, expressions, of, &name)?;
        Ok(Declared { name, range })
    })
}

/// Reports a value after a name.
fn no_value(stream: ParseStream, expressions: &mut Expressions, of: &str, name: &Ident) -> syn::Result<()> {
    let found = stream.span();
    if stream.parse::<Option<Token![=]>>()?.is_some() {
        let message = format!("a name after `{of}` has no value here: pass it to the functions; write `{name}`");
        expressions.slip(found, message);
        precedence::parse(stream, expressions)?;
    }
    Ok(())
}

type Item<'a, V> = &'a dyn Fn(ParseStream, &mut Expressions) -> syn::Result<V>;

fn listed<V>(stream: ParseStream, expressions: &mut Expressions, item: Item<V>) -> syn::Result<Vec<V>> {
    if let Some((content, region)) = group(stream) {
        expressions.slip(region, "remove these parentheses: names are separated by commas");
        return Parser::parse2(|inner: ParseStream| items(inner, expressions, item), content);
    }
    items(stream, expressions, item)
}

fn group(stream: ParseStream) -> Option<(proc_macro2::TokenStream, Region)> {
    let ahead = stream.fork();
    match ahead.parse() {
        Ok(TokenTree::Group(group)) if group.delimiter() != Delimiter::None => {
            syn::parse::discouraged::Speculative::advance_to(stream, &ahead);
            Some((group.stream(), Region::from(group.span_open()).to(group.span_close().into())))
        }
        _ => None,
    }
}

fn items<V>(stream: ParseStream, expressions: &mut Expressions, item: Item<V>) -> syn::Result<Vec<V>> {
    let mut items = vec![item(stream, expressions)?];
    while goes_on(stream, expressions)? {
        items.push(item(stream, expressions)?);
    }
    Ok(items)
}

/// Parses what separates two items; a missing comma, or one too many, is reported.
fn goes_on(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<bool> {
    loop {
        let found = stream.span();
        if stream.parse::<Option<Token![,]>>()?.is_none() {
            return without_comma(stream, expressions);
        }
        if at_keyword(stream) && stream.peek2(syn::Ident) {
            return Err(syn::Error::new(found, "expected `;`, found `,`: a keyword follows"));
        }
        while stream.peek(Token![,]) {
            let again = stream.span();
            stream.parse::<Token![,]>()?;
            expressions.slip(again, "expected a name: remove this `,`");
        }
        // A decimal comma: after its digits the list goes on.
        if let Ok(literal) = stream.fork().parse::<syn::LitInt>() {
            stream.parse::<TokenTree>()?;
            expressions.slip(literal.span(), "expected a name: a decimal point is `.`, as in `80.5`");
            continue;
        }
        let ends = stream.is_empty() || stream.peek(Token![;]);
        if ends {
            let at = if stream.is_empty() { found } else { stream.span() };
            expressions.slip(at, "expected a name after `,`");
        }
        return Ok(!ends);
    }
}

/// True if another item follows without a comma, which is reported.
fn without_comma(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<bool> {
    let found = stream.span();
    let begins = at_keyword(stream) || at_word(stream, &EFFECTS) || at_word(stream, &PROPERTIES);
    let is_name = stream.peek(syn::Ident) && !begins;
    if is_name {
        let and = stream.peek2(syn::Ident) && stream.fork().call(Ident::parse_any).is_ok_and(|word| word == "and");
        if and {
            stream.parse::<Ident>()?;
            expressions.slip(found, "expected `,`, found `and`");
        } else {
            expressions.slip(found, "expected `,` before this");
        }
    }
    Ok(is_name)
}

/// Reports a type after a name.
fn skip_type(stream: ParseStream, expressions: &mut Expressions, of: &str, name: &Ident) -> syn::Result<()> {
    // `name: 80` has another sign for `=`.
    if !(stream.peek(Token![:]) && (stream.peek2(syn::Ident) || stream.peek2(Token![&]))) {
        return Ok(());
    }
    let mut region = Region::from(stream.span());
    while !(stream.is_empty() || [",", ";", "="].iter().any(|sign| take(&stream.fork(), sign).is_some())) {
        region = region.to(stream.parse::<TokenTree>()?.span().into());
    }
    expressions.slip(region, format!("{of} has no type here: write `{name}`"));
    Ok(())
}
