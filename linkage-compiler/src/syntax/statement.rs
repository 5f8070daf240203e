//! Statements, each ended by `;` or braces.

use proc_macro2::{Ident, Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::{Attribute, Path, Token};

use super::expression::{self, ExpressionId, Expressions};
use super::kind::{KEYWORDS, StatementKind};
use super::tokens::{end, equals, name};
use super::{attributes, recovery, scene};
use crate::diagnostics::{Diagnostics, nearest, suggestion};

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
        let attributes = attributes::read(stream, diagnostics);
        let (before, messages) = (expressions.len(), diagnostics.len());
        let ahead = stream.fork();
        let read = kind(&ahead, expressions, diagnostics).and_then(|kind| {
            // A statement that ends with braces needs no `;`.
            if matches!(kind, StatementKind::Body(_) | StatementKind::Scene(_)) {
                if ahead.peek(Token![;]) {
                    ahead.parse::<TokenTree>()?;
                }
                return Ok(kind);
            }
            let last = expressions.last_region().filter(|_| expressions.len() > before);
            match end(&ahead, last) {
                // Only the `;` is missing.
                Err(error) if ahead.is_empty() || at_keyword(&ahead) => {
                    diagnostics.push(error);
                    Ok(kind)
                }
                Err(error) => Err(error),
                Ok(()) => Ok(kind),
            }
        });
        let kind = match read {
            Ok(kind) => {
                stream.advance_to(&ahead);
                kind
            }
            Err(error) => {
                if diagnostics.len() == messages {
                    diagnostics.push(error);
                }
                expressions.truncate(before);
                recovery::kind(&statement_tokens(stream), expressions)
            }
        };
        let attributes = attributes::meant(attributes, kind.bearer(), diagnostics);
        statements.push(Statement { attributes, kind });
    }
    statements
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

fn kind(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<StatementKind> {
    let keyword: Ident = stream
        .call(Ident::parse_any)
        .map_err(|error| syn::Error::new(error.span(), format!("expected a statement: {}", KEYWORDS.join(", "))))?;
    let mut word = keyword.to_string();
    if !KEYWORDS.contains(&word.as_str()) {
        let hint = suggestion(&word, KEYWORDS);
        diagnostics.error(
            keyword.span(),
            format_args!("unknown statement `{word}`{hint}\nstatements: {}", KEYWORDS.join(", ")),
        );
        word = nearest(&word, KEYWORDS).unwrap_or_default().to_owned();
    }
    Ok(match word.as_str() {
        "param" => {
            let mut parameters = Vec::new();
            loop {
                let name = listed(stream)?;
                let default = if stream.parse::<Option<Token![=]>>()?.is_some() {
                    Some(expression::parse(stream, expressions)?)
                } else {
                    None
                };
                parameters.push((name, default));
                if stream.parse::<Option<Token![,]>>()?.is_none() {
                    break StatementKind::Parameters(parameters);
                }
            }
        }
        "input" => StatementKind::Inputs(names(stream)?),
        "unknown" => StatementKind::Unknowns(names(stream)?),
        "coordinate" => StatementKind::Coordinates(names(stream)?),
        "drive" => {
            let name = name(stream)?;
            let by: Ident = stream.call(Ident::parse_any)?;
            if by != "by" {
                return Err(syn::Error::new(by.span(), "expected `by`: `drive NAME by COORDINATE;`"));
            }
            StatementKind::Drive { name, by: names(stream)? }
        }
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
            let name = name(stream)?;
            equals(stream)?;
            let value = expression::parse(stream, expressions)?;
            match word.as_str() {
                "let" => StatementKind::Let { name, value },
                "point" => StatementKind::Point { name, value },
                _ => StatementKind::Output { name, value },
            }
        }
        "extern" => external(stream, keyword.span())?,
        "derive" => StatementKind::Derive(names(stream)?),
        "body" => StatementKind::Body(scene::body(stream, expressions, diagnostics)?),
        "scene" => StatementKind::Scene(scene::scene(stream, expressions, diagnostics)?),
        _ => return Err(syn::Error::new(keyword.span(), "unknown statement")),
    })
}

/// A name in a list; a keyword instead of it means that a `;` is missing.
fn listed(stream: ParseStream) -> syn::Result<Ident> {
    if at_keyword(stream) && stream.peek2(syn::Ident) {
        return Err(syn::Error::new(stream.span(), "expected a name; end the statement before this with `;`"));
    }
    name(stream)
}

fn names(stream: ParseStream) -> syn::Result<Vec<Ident>> {
    let mut names = vec![listed(stream)?];
    while stream.parse::<Option<Token![,]>>()?.is_some() {
        names.push(listed(stream)?);
    }
    Ok(names)
}

/// Parses `fn path::of(x, p) -> (f, df, ddf)`, after `extern`.
fn external(stream: ParseStream, keyword: Span) -> syn::Result<StatementKind> {
    const FORM: &str = "`extern fn path::to(x) -> (f, df, ddf);`";
    let expected = |found: Span, what: &str| syn::Error::new(found, format!("expected {what}: {FORM}"));
    let found = if stream.is_empty() { keyword } else { stream.span() };
    stream.parse::<Token![fn]>().map_err(|_| expected(found, "`fn`"))?;
    let found = stream.span();
    let path = Path::parse_mod_style(stream).map_err(|_| expected(found, "the path of a function"))?;
    let arguments = list(stream, |found| expected(found, "the arguments in parentheses"))?;
    let found = stream.span();
    stream.parse::<Token![->]>().map_err(|_| expected(found, "`->` and the names of its results"))?;
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
    let (left, right) = sides(stream, expressions)?;
    Ok(match what {
        "loop" => StatementKind::Loop { left, right, is_implied },
        _ => StatementKind::Equation { left, right, is_implied },
    })
}

fn sides(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<(ExpressionId, ExpressionId)> {
    let left = expression::parse(stream, expressions)?;
    equals(stream)?;
    Ok((left, expression::parse(stream, expressions)?))
}

/// True before an attribute, and before a keyword that begins a statement.
fn at_keyword(stream: ParseStream) -> bool {
    let ahead = stream.fork();
    let at_word = ahead.call(Ident::parse_any).is_ok_and(|word| KEYWORDS.iter().any(|keyword| word == *keyword));
    let goes_on = !(ahead.is_empty() || ahead.peek(Token![;]) || ahead.peek(Token![,]) || ahead.peek(Token![=]));
    stream.peek(Token![#]) || (at_word && goes_on)
}
