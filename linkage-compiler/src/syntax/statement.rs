//! Statements, each ended by `;` or braces.

use proc_macro2::{Ident, Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::{Attribute, Path, Token};

use super::expression::{ExpressionId, Expressions};
use super::kind::{KEYWORDS, StatementKind, at_keyword, meant};
use super::list::{declared, names, parameters};
use super::punctuation::{end, equals};
use super::range::{no_range, range};
use super::tokens::name;
use super::{attributes, items, precedence, recovery};
use crate::diagnostics::Diagnostics;

/// A statement with its attributes.
pub struct Statement {
    pub attributes: Vec<Attribute>,
    pub kind: StatementKind,
}

/// Parses all statements up to the end of the braces.
pub(super) fn statements(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> Vec<Statement> {
    let mut statements = Vec::new();
    while !stream.is_empty() {
        if stream.peek(Token![;]) {
            diagnostics.error(stream.span(), "remove this `;`: the statement ends before it");
            drop(stream.parse::<TokenTree>());
            continue;
        }
        let attributes = attributes::read(stream, diagnostics);
        if let (true, Some(last)) = (stream.is_empty(), attributes.last()) {
            let region = syn::spanned::Spanned::span(last);
            diagnostics.error(region, "expected a statement after this comment or attribute");
            break;
        }
        let kind = statement(stream, expressions, diagnostics);
        let attributes = attributes::meant(attributes, kind.bearer(), diagnostics);
        statements.push(Statement { attributes, kind });
    }
    statements
}

/// Parses one statement; its mistakes are reported.
fn statement(stream: ParseStream, expressions: &mut Expressions, diagnostics: &mut Diagnostics) -> StatementKind {
    let (before, messages) = (expressions.len(), diagnostics.len());
    let word = match keyword(stream, diagnostics) {
        Ok(word) => word,
        Err(error) => {
            if diagnostics.len() == messages {
                diagnostics.push(error);
            }
            return quantity(stream, expressions, diagnostics)
                .unwrap_or_else(|| recovery::kind(&statement_tokens(stream), expressions));
        }
    };
    let ahead = stream.fork();
    let read = ended(&ahead, &word, expressions, diagnostics);
    diagnostics.extend(expressions.take_slips());
    match read {
        Ok(kind) => {
            stream.advance_to(&ahead);
            kind
        }
        Err(error) => {
            // After a wrong keyword the rest may be wrong as well.
            if diagnostics.len() == messages {
                diagnostics.push(error);
            }
            expressions.truncate(before);
            let tokens = statement_tokens(stream);
            recovery::record_keywords(&tokens, expressions);
            recovery::of_keyword(&word, &tokens, expressions)
        }
    }
}

/// Parses `NAME = EXPRESSION;` without a keyword, unless it is a list of parameters.
fn quantity(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> Option<StatementKind> {
    let (before, ahead) = (expressions.len(), stream.fork());
    let read = named_value(&ahead, expressions).ok().filter(|(_, value)| expressions.digits(*value).is_none());
    let slips = expressions.take_slips();
    let Some((name, value)) = read else {
        expressions.truncate(before);
        return None;
    };
    diagnostics.extend(slips);
    stream.advance_to(&ahead);
    Some(StatementKind::Quantity { name, value })
}

fn named_value(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<(Ident, ExpressionId)> {
    let name = name(stream)?;
    stream.parse::<Token![=]>()?;
    let value = precedence::parse(stream, expressions)?;
    stream.parse::<Token![;]>()?;
    Ok((name, value))
}

/// Parses a statement with its end.
fn ended(
    stream: ParseStream,
    keyword: &Ident,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<StatementKind> {
    let before = expressions.len();
    let kind = kind(stream, keyword, expressions, diagnostics)?;
    // A statement that ends with braces needs no `;`.
    if matches!(kind, StatementKind::Body(_) | StatementKind::Scene(_)) {
        if stream.peek(Token![;]) {
            stream.parse::<TokenTree>()?;
        }
        return Ok(kind);
    }
    let last = expressions.last_region().filter(|_| expressions.len() > before);
    match end(stream, last) {
        // Only the `;` is missing.
        Err(error) if stream.is_empty() || at_keyword(stream) => {
            if !expressions.has_slips() {
                diagnostics.push(error);
            }
            Ok(kind)
        }
        Err(error) => Err(error),
        Ok(()) => Ok(kind),
    }
}

/// Takes the tokens up to the end of a statement, without its `;`.
fn statement_tokens(stream: ParseStream) -> Vec<TokenTree> {
    let mut tokens: Vec<TokenTree> = Vec::new();
    // `implied` goes with the keyword after it.
    let is_begun = |tokens: &[TokenTree]| match tokens {
        [] => false,
        [TokenTree::Ident(word)] => word != "implied",
        _ => true,
    };
    while !stream.is_empty() && (!is_begun(&tokens) || !at_keyword(stream)) {
        match stream.parse::<TokenTree>() {
            Ok(TokenTree::Punct(punct)) if punct.as_char() == ';' => break,
            Ok(token) => tokens.push(token),
            Err(_) => break,
        }
    }
    tokens
}

/// Parses the keyword of a statement. Another word is reported, and returned as the keyword that is meant.
fn keyword(stream: ParseStream, diagnostics: &mut Diagnostics) -> syn::Result<Ident> {
    if stream.peek(Token![%]) || stream.peek(Token![-]) {
        return Err(stream.error("expected a statement: a comment begins with `//`"));
    }
    let expected =
        |error: syn::Error| syn::Error::new(error.span(), format!("expected a statement: {}", KEYWORDS.join(", ")));
    let ahead = stream.fork();
    let mut keyword: Ident = ahead.call(Ident::parse_any).map_err(expected)?;
    if keyword == "pub" && at_keyword(&ahead) {
        diagnostics.error(keyword.span(), "remove this `pub`: all parts of a mechanism are as visible as it is");
        keyword = ahead.call(Ident::parse_any)?;
    }
    let word = keyword.to_string();
    if !KEYWORDS.contains(&word.as_str()) {
        let candidates = meant(&word);
        let is_only = candidates.len() == 1;
        let fits = |candidate: &&&str| recovery::fits(candidate, is_only, &ahead);
        let Some(candidate) = candidates.iter().find(fits) else {
            return Err(syn::Error::new(keyword.span(), recovery::without_keyword(&word, &ahead)));
        };
        diagnostics.error(keyword.span(), format_args!("unknown statement `{word}`, did you mean `{candidate}`?"));
        keyword = Ident::new(candidate, keyword.span());
    }
    if word == "fn" {
        // It is parsed after `extern`.
        return Ok(keyword);
    }
    if let Ok(colon) = ahead.parse::<Token![:]>() {
        diagnostics.error(colon.span, format_args!("remove this `:`: write `{keyword} …;`"));
    }
    stream.advance_to(&ahead);
    Ok(keyword)
}

fn kind(
    stream: ParseStream,
    keyword: &Ident,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<StatementKind> {
    let word = keyword.to_string();
    Ok(match word.as_str() {
        "param" => StatementKind::Parameters(parameters(stream, expressions)?),
        "input" => StatementKind::Inputs(declared(stream, expressions, &word)?),
        "unknown" => StatementKind::Unknowns(declared(stream, expressions, &word)?),
        "coordinate" => StatementKind::Coordinates(declared(stream, expressions, &word)?),
        "drive" => drive(stream, expressions)?,
        "loop" | "equation" => closed(&word, false, stream, expressions)?,
        "implied" => {
            const FORM: &str = "`implied loop … = …;` or `implied equation … = …;`";
            let found = if stream.is_empty() { keyword.span() } else { stream.span() };
            let what = stream.call(Ident::parse_any).map(|what| what.to_string()).unwrap_or_default();
            if !["loop", "equation"].contains(&what.as_str()) {
                return Err(syn::Error::new(found, format!("expected `loop` or `equation`: {FORM}")));
            }
            closed(&what, true, stream, expressions)?
        }
        "let" | "point" | "output" => {
            if let Ok(mutable) = stream.parse::<Token![mut]>() {
                expressions.slip(mutable.span, "remove this `mut`: the value of a name does not change");
            }
            let name = name(stream)?;
            after_name(stream, &word, &name, expressions)?;
            let range = match word.as_str() {
                "output" => range(stream, expressions, &name)?,
                _ => no_range(stream, expressions, &format!("a `{word}`"), &name).map(|()| None)?,
            };
            equals(stream, expressions, &format!("{word} {name} = …;"))?;
            let value = precedence::parse(stream, expressions)?;
            match word.as_str() {
                "let" => StatementKind::Let { name, value },
                "point" => StatementKind::Point { name, value },
                _ => StatementKind::Output { name, range, value },
            }
        }
        "extern" => external(stream, keyword.span(), expressions)?,
        "derive" => StatementKind::Derive(names(stream, expressions, &word)?),
        "body" => StatementKind::Body(items::body(stream, expressions, diagnostics)?),
        "scene" => StatementKind::Scene(items::scene(stream, expressions, diagnostics)?),
        _ => return Err(syn::Error::new(keyword.span(), "unknown statement")),
    })
}

/// Reports arguments or a type after the name of a `let`, a `point` or an `output`.
fn after_name(stream: ParseStream, word: &str, name: &Ident, expressions: &mut Expressions) -> syn::Result<()> {
    let found = stream.span();
    if stream.peek(Token![,]) {
        return Err(syn::Error::new(found, format!("expected `=`, found `,`: write one `{word}` for each name")));
    }
    if stream.peek(syn::token::Paren) {
        let found = stream.parse::<TokenTree>()?.span();
        let message = format!("`{name}` has no arguments: write `{word} {name} = …;` with the coordinates in it");
        expressions.slip(found, message);
    }
    if stream.peek(Token![:]) && stream.peek2(syn::Ident) && stream.peek3(Token![=]) {
        let colon = stream.span();
        stream.parse::<TokenTree>()?;
        let of = stream.parse::<TokenTree>()?.span();
        let region = crate::diagnostics::Region { first: colon, last: of };
        expressions.slip(region, format!("`{name}` has no type here: write `{word} {name} = …;`"));
    }
    Ok(())
}

/// Parses `NAME by q`, after `drive`.
fn drive(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<StatementKind> {
    const FORM: &str = "write `drive NAME by COORDINATE;`";
    let name = name(stream)?;
    if name == "by" {
        return Err(syn::Error::new(name.span(), format!("expected the name of the driver before `by`: {FORM}")));
    }
    let found = stream.span();
    if !super::tokens::word(stream, "by") {
        let other = ["=", ":"].into_iter().find(|sign| super::tokens::take(stream, sign).is_some());
        // Another word, before the coordinate.
        let is_word = other.is_none() && stream.peek2(syn::Ident);
        if is_word {
            stream.parse::<TokenTree>()?;
        }
        expressions.slip(found, format!("expected `by`: {FORM}"));
    }
    if stream.peek(Token![;]) {
        return Err(syn::Error::new(stream.span(), format!("expected a coordinate after `by`: {FORM}")));
    }
    Ok(StatementKind::Drive { name, by: names(stream, expressions, "by")? })
}

/// Parses `fn path::of(x, p) -> (f, df, ddf)`, after `extern`.
fn external(stream: ParseStream, keyword: Span, expressions: &mut Expressions) -> syn::Result<StatementKind> {
    const FORM: &str = "`extern fn path::to(x) -> (f, df, ddf);`";
    let expected = |found: Span, what: &str| syn::Error::new(found, format!("expected {what}: {FORM}"));
    let found = if stream.is_empty() { keyword } else { stream.span() };
    if let Ok(abi) = stream.parse::<syn::LitStr>() {
        expressions.slip(abi.span(), format!("remove the name of the ABI: {FORM}"));
    }
    if stream.parse::<Option<Token![fn]>>()?.is_none() {
        if !stream.peek(syn::Ident) {
            return Err(expected(found, "`fn`"));
        }
        expressions.slip(found, format!("expected `fn` before this: {FORM}"));
    }
    let found = stream.span();
    let path = Path::parse_mod_style(stream).map_err(|_| expected(found, "the path of a function"))?;
    if stream.peek(Token![<]) {
        let mut region = crate::diagnostics::Region::from(stream.span());
        while !stream.is_empty() && !stream.peek(syn::token::Paren) && !stream.peek(Token![;]) {
            region = region.to(stream.parse::<TokenTree>()?.span().into());
        }
        expressions.slip(region, format!("a function is generic here without saying so: {FORM}"));
    }
    let arguments = list(stream, |found| expected(found, "the arguments in parentheses"))?;
    let found = stream.span();
    if super::tokens::take(stream, "->").is_none() {
        if super::tokens::take(stream, "=").is_none() {
            return Err(expected(found, "`->` and the names of its results"));
        }
        expressions.slip(found, format!("expected `->`, found `=`: {FORM}"));
    }
    let names = list(stream, |found| expected(found, "the names of its value and its derivatives"))?;
    Ok(StatementKind::External { path, arguments, names })
}

/// Parses names in parentheses, at least one.
fn list(stream: ParseStream, missing: impl Fn(Span) -> syn::Error) -> syn::Result<Vec<Ident>> {
    let found = stream.span();
    if !stream.peek(syn::token::Paren) {
        return Err(missing(found));
    }
    let content;
    syn::parenthesized!(content in stream);
    let mut names = Vec::new();
    while !content.is_empty() {
        names.push(name(&content)?);
        if content.peek(Token![:]) {
            return Err(syn::Error::new(content.span(), "an argument has no type here: write its name only"));
        }
        if content.is_empty() {
            break;
        }
        let found = content.span();
        content.parse::<Token![,]>().map_err(|_| syn::Error::new(found, "expected `,` or `)`"))?;
    }
    if names.is_empty() { Err(missing(found)) } else { Ok(names) }
}

/// Parses the two sides of a `loop` or an `equation`.
fn closed(
    what: &str,
    is_implied: bool,
    stream: ParseStream,
    expressions: &mut Expressions,
) -> syn::Result<StatementKind> {
    let form = if what == "loop" { "loop VECTOR = VECTOR;" } else { "equation SCALAR = SCALAR;" };
    let (left, right) = sides(stream, expressions, form)?;
    Ok(match what {
        "loop" => StatementKind::Loop { left, right, is_implied },
        _ => StatementKind::Equation { left, right, is_implied },
    })
}

fn sides(stream: ParseStream, expressions: &mut Expressions, form: &str) -> syn::Result<(ExpressionId, ExpressionId)> {
    let left = precedence::parse(stream, expressions)?;
    if stream.peek(Token![;]) {
        let region = stream.span();
        expressions.slip(region, format!("expected `=` and the other side, which may be `0`: write `{form}`"));
        let right = expressions.zero(region);
        return Ok((left, right));
    }
    equals(stream, expressions, form)?;
    let right = precedence::parse(stream, expressions)?;
    let found = stream.span();
    if stream.peek(Token![=]) && !stream.peek(Token![==]) {
        stream.parse::<Token![=]>()?;
        expressions.slip(found, "a statement has one `=`: write a statement for each");
        precedence::parse(stream, expressions)?;
    }
    Ok((left, right))
}
