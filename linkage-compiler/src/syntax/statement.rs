//! Statements: one a line of the language, each ended by `;`.

use proc_macro2::{Ident, Span, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Attribute, Path, Token};

use super::attributes::{self, Bearer};
use super::expression::{self, ExpressionId, Expressions};
use super::scene::{self, Body, Scene};
use crate::diagnostics::{Diagnostics, Region, suggestion};

/// A statement and the doc comments above it.
pub struct Statement {
    pub attributes: Vec<Attribute>,
    pub kind: StatementKind,
}

/// What a statement says.
pub enum StatementKind {
    Parameters(Vec<(Ident, Option<ExpressionId>)>),
    Inputs(Vec<Ident>),
    Unknowns(Vec<Ident>),
    Coordinates(Vec<Ident>),
    Drive {
        name: Ident,
        by: Vec<Ident>,
    },
    Loop {
        left: ExpressionId,
        right: ExpressionId,
    },
    Equation {
        left: ExpressionId,
        right: ExpressionId,
    },
    Let {
        name: Ident,
        value: ExpressionId,
    },
    Point {
        name: Ident,
        value: ExpressionId,
    },
    Output {
        name: Ident,
        value: ExpressionId,
    },
    /// A function of the user's: where it is found, what it takes and gives.
    External {
        path: Path,
        arguments: Vec<Ident>,
        names: Vec<Ident>,
    },
    Derive(Vec<Ident>),
    Body(Body),
    Scene(Scene),
}

impl StatementKind {
    /// The construct that its attributes belong to.
    fn bearer(&self) -> Bearer {
        match self {
            Self::Parameters(_) | Self::Drive { .. } | Self::Scene(_) => Bearer::Item,
            Self::Inputs(_) | Self::Unknowns(_) | Self::Coordinates(_) | Self::Point { .. } | Self::Output { .. } => {
                Bearer::Field
            }
            Self::Loop { .. }
            | Self::Equation { .. }
            | Self::Let { .. }
            | Self::External { .. }
            | Self::Derive(_)
            | Self::Body(_) => Bearer::Part,
        }
    }
}

const KEYWORDS: [&str; 14] = [
    "param",
    "input",
    "unknown",
    "coordinate",
    "drive",
    "loop",
    "equation",
    "let",
    "point",
    "output",
    "extern",
    "derive",
    "body",
    "scene",
];

/// Every statement up to the end of the braces.
pub(super) fn statements(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> Vec<Statement> {
    let mut statements = Vec::new();
    while !stream.is_empty() {
        let attributes = match stream.call(Attribute::parse_outer) {
            Ok(attributes) => attributes,
            Err(error) => {
                diagnostics.push(error);
                skip_statement(stream);
                continue;
            }
        };
        let before = expressions.len();
        match kind(stream, expressions, diagnostics) {
            // Braces end a statement.
            Ok(kind @ (StatementKind::Body(_) | StatementKind::Scene(_))) => {
                let attributes = attributes::meant(attributes, kind.bearer(), diagnostics);
                statements.push(Statement { attributes, kind });
                if stream.peek(Token![;]) {
                    skip_statement(stream);
                }
            }
            Ok(kind) => {
                let attributes = attributes::meant(attributes, kind.bearer(), diagnostics);
                statements.push(Statement { attributes, kind });
                let last = expressions.last_region().filter(|_| expressions.len() > before);
                if let Err(error) = end(stream, last) {
                    diagnostics.push(error);
                    if !at_keyword(stream) {
                        skip_statement(stream);
                    }
                }
            }
            Err(error) => {
                diagnostics.push(error);
                expressions.truncate(before);
                skip_statement(stream);
            }
        }
    }
    statements
}

fn kind(
    stream: ParseStream,
    expressions: &mut Expressions,
    diagnostics: &mut Diagnostics,
) -> syn::Result<StatementKind> {
    let keyword: Ident = stream
        .call(Ident::parse_any)
        .map_err(|error| syn::Error::new(error.span(), format!("expected a statement: {}", KEYWORDS.join(", "))))?;
    let word = keyword.to_string();
    Ok(match word.as_str() {
        "param" => {
            let mut parameters = Vec::new();
            loop {
                let name = name(stream)?;
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
        "loop" => {
            let (left, right) = sides(stream, expressions)?;
            StatementKind::Loop { left, right }
        }
        "equation" => {
            let (left, right) = sides(stream, expressions)?;
            StatementKind::Equation { left, right }
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
        unknown => {
            let hint = suggestion(unknown, KEYWORDS);
            return Err(syn::Error::new(
                keyword.span(),
                format!("no statement begins with `{unknown}`{hint}\nstatements: {}", KEYWORDS.join(", ")),
            ));
        }
    })
}

pub(super) fn name(stream: ParseStream) -> syn::Result<Ident> {
    let is_free = stream.peek(syn::Ident);
    let name = stream.call(Ident::parse_any).map_err(|error| syn::Error::new(error.span(), "expected a name"))?;
    let text = name.to_string();
    if !is_free || text.starts_with("r#") {
        return Err(syn::Error::new(name.span(), format!("`{text}` is a word of Rust; choose another name")));
    }
    Ok(name)
}

fn names(stream: ParseStream) -> syn::Result<Vec<Ident>> {
    let mut names = vec![name(stream)?];
    while stream.parse::<Option<Token![,]>>()?.is_some() {
        names.push(name(stream)?);
    }
    Ok(names)
}

/// The rest of `extern fn path::of(x, p) -> (f, df, ddf)`.
fn external(stream: ParseStream, keyword: Span) -> syn::Result<StatementKind> {
    const FORM: &str = "`extern fn path::to(x) -> (f, df, ddf);`";
    let expected = |found: Span, what: &str| syn::Error::new(found, format!("expected {what}: {FORM}"));
    let found = if stream.is_empty() { keyword } else { stream.span() };
    stream.parse::<Token![fn]>().map_err(|_| expected(found, "`fn`"))?;
    let found = stream.span();
    let path = Path::parse_mod_style(stream).map_err(|_| expected(found, "the path of a function"))?;
    let arguments = list(stream, |found| expected(found, "what it takes"))?;
    let found = stream.span();
    stream.parse::<Token![->]>().map_err(|_| expected(found, "what it gives"))?;
    let names = list(stream, |found| expected(found, "the names of its value and its derivatives"))?;
    Ok(StatementKind::External { path, arguments, names })
}

/// Names in parentheses, at least one.
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

pub(super) fn equals(stream: ParseStream) -> syn::Result<()> {
    let found = stream.span();
    stream.parse::<Token![=]>().map(drop).map_err(|_| syn::Error::new(found, "expected `=`"))
}

fn sides(stream: ParseStream, expressions: &mut Expressions) -> syn::Result<(ExpressionId, ExpressionId)> {
    let left = expression::parse(stream, expressions)?;
    equals(stream)?;
    Ok((left, expression::parse(stream, expressions)?))
}

/// The `;`; at the end of the braces its absence is reported on the last token that was written.
pub(super) fn end(stream: ParseStream, last: Option<Region>) -> syn::Result<()> {
    if stream.is_empty() {
        let span = last.map_or_else(|| stream.span(), |region| region.last);
        return Err(syn::Error::new(span, "expected `;` after this"));
    }
    let found = stream.span();
    stream.parse::<Token![;]>().map(drop).map_err(|_| syn::Error::new(found, "expected `;` before this"))
}

fn at_keyword(stream: ParseStream) -> bool {
    stream.peek(Token![#])
        || stream.fork().call(Ident::parse_any).is_ok_and(|word| KEYWORDS.iter().any(|keyword| word == *keyword))
}

fn skip_statement(stream: ParseStream) {
    let mut moved = false;
    while !stream.is_empty() {
        if moved && at_keyword(stream) {
            return;
        }
        moved = true;
        match stream.parse::<TokenTree>() {
            Ok(TokenTree::Punct(punct)) if punct.as_char() == ';' => return,
            Ok(_) => {}
            Err(_) => return,
        }
    }
}
