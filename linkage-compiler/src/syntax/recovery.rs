//! Error recovery: the names that a statement with a syntax error seems to declare.

use proc_macro2::{Ident, Span, TokenTree};

use super::expression::{ExpressionId, Expressions, Unread};
use super::kind::{KEYWORDS, StatementKind};
use super::scene::{Body, Scene};
use crate::diagnostics::{Region, nearest};

/// Guesses the kind of a statement from its tokens, including the keyword.
pub(super) fn kind(tokens: &[TokenTree], expressions: &mut Expressions) -> StatementKind {
    let [TokenTree::Ident(keyword), rest @ ..] = tokens else { return unread(tokens) };
    if keyword == "implied" {
        return match kind(rest, expressions) {
            StatementKind::Loop { left, right, .. } => StatementKind::Loop { left, right, is_implied: true },
            StatementKind::Equation { left, right, .. } => StatementKind::Equation { left, right, is_implied: true },
            other => other,
        };
    }
    let names = || rest.iter().filter_map(name);
    let first = rest.first().and_then(name);
    let value = |expressions: &mut Expressions| unread_value(rest, keyword.span(), expressions);
    let word = keyword.to_string();
    match (nearest(&word, KEYWORDS).unwrap_or_default(), first) {
        ("param", _) => parameters(rest, expressions),
        ("input", _) => StatementKind::Inputs(names().collect()),
        ("unknown", _) => StatementKind::Unknowns(names().collect()),
        ("coordinate", _) => StatementKind::Coordinates(names().collect()),
        ("derive", _) => StatementKind::Derive(names().collect()),
        ("drive", Some(name)) => {
            StatementKind::Drive { name, by: names().skip(1).filter(|word| word != "by").collect() }
        }
        ("loop", _) => StatementKind::Loop { left: value(expressions), right: value(expressions), is_implied: false },
        ("equation", _) => {
            StatementKind::Equation { left: value(expressions), right: value(expressions), is_implied: false }
        }
        ("let", Some(name)) => StatementKind::Let { name, value: value(expressions) },
        ("point", Some(name)) => StatementKind::Point { name, value: value(expressions) },
        ("output", Some(name)) => StatementKind::Output { name, value: value(expressions) },
        ("body", Some(name)) => StatementKind::Body(Body { name, properties: Vec::new(), is_complete: false }),
        ("scene", Some(name)) => {
            let is_of = names().nth(1).is_some_and(|word| word == "of");
            let of = names().nth(2).filter(|_| is_of);
            StatementKind::Scene(Scene { name, of, effects: Vec::new(), is_complete: false })
        }
        ("", Some(_)) if is_punct(rest.get(1), '=') && matches!(rest.get(2), Some(TokenTree::Literal(_))) => {
            parameters(rest, expressions)
        }
        ("", Some(name)) if is_punct(rest.get(1), '=') => StatementKind::Quantity { name, value: value(expressions) },
        ("", _) if is_punct(rest.first(), '=') => {
            StatementKind::Quantity { name: keyword.clone(), value: value(expressions) }
        }
        _ => unread(rest),
    }
}

/// Parameters: each name at the beginning, after a comma or before `=`.
fn parameters(tokens: &[TokenTree], expressions: &mut Expressions) -> StatementKind {
    let mut parameters = Vec::new();
    for (place, token) in tokens.iter().enumerate() {
        let Some(name) = name(token) else { continue };
        let begins = place == 0 || is_punct(tokens.get(place - 1), ',');
        let next = tokens.get(place + 1);
        if begins || is_punct(next, '=') {
            let is_alone = next.is_none() || is_punct(next, ',');
            let default = (!is_alone).then(|| expressions.unread(Vec::new(), name.span().into()));
            parameters.push((name, default));
        }
    }
    StatementKind::Parameters(parameters)
}

/// A statement of unknown kind, with all names at any depth.
fn unread(tokens: &[TokenTree]) -> StatementKind {
    let is_list = tokens.iter().all(|token| name(token).is_some() || is_punct(Some(token), ','));
    let names = names_with_places(tokens).into_iter().map(|unread| unread.name);
    StatementKind::Unread { names: names.collect(), is_list }
}

fn unread_value(tokens: &[TokenTree], keyword: Span, expressions: &mut Expressions) -> ExpressionId {
    let first = tokens.first().map_or(keyword, TokenTree::span);
    let last = tokens.last().map_or(keyword, TokenTree::span);
    expressions.unread(names_with_places(tokens), Region { first, last })
}

/// All names at any depth, with their position relative to `@`.
fn names_with_places(tokens: &[TokenTree]) -> Vec<Unread> {
    let mut names = Vec::new();
    let mut levels = vec![tokens.to_vec()];
    while let Some(tokens) = levels.pop() {
        for (place, token) in tokens.iter().enumerate() {
            if let TokenTree::Group(group) = token {
                levels.push(group.stream().into_iter().collect());
            }
            if let Some(name) = name(token) {
                let is_angle = place > 0 && is_punct(tokens.get(place - 1), '@');
                names.push(Unread { name, is_angle, is_length: is_punct(tokens.get(place + 1), '@') });
            }
        }
    }
    names
}

/// The token as a name, unless it is a Rust keyword.
fn name(token: &TokenTree) -> Option<Ident> {
    match token {
        TokenTree::Ident(name) => syn::parse_str::<Ident>(&name.to_string()).is_ok().then(|| name.clone()),
        _ => None,
    }
}

fn is_punct(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}
