//! Error recovery: the names that a statement with a syntax error seems to declare.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::parse::ParseStream;

use super::expression::{ExpressionId, Expressions, Unread};
use super::identifier::{can_be_name, is_keyword, plain};
use super::kind::{Declared, KEYWORDS, StatementKind};
use super::scene::{self, Body, Scene};
use crate::diagnostics::Region;

/// The tokens up to the end of a statement, without moving on.
fn ahead(stream: ParseStream) -> Vec<TokenTree> {
    let ahead = stream.fork();
    let mut tokens = Vec::new();
    while let Ok(token) = ahead.parse::<TokenTree>() {
        if matches!(&token, TokenTree::Punct(punct) if punct.as_char() == ';') {
            break;
        }
        tokens.push(token);
    }
    tokens
}

/// True if the rest of a statement may follow a keyword; `is_only` if no other keyword is meant.
pub(super) fn fits(keyword: &str, is_only: bool, stream: ParseStream) -> bool {
    let tokens = ahead(stream);
    let has_at = || tokens.iter().any(|token| is_punct(Some(token), '@'));
    match keyword {
        "let" | "point" | "output" => tokens.iter().any(|token| is_punct(Some(token), '=')),
        "loop" => is_only || has_at(),
        "equation" => is_only || !has_at(),
        "drive" => is_only || tokens.iter().any(|token| is_word(token, "by")),
        // A mechanism with `drive` has coordinates.
        "input" => is_only || !tokens.iter().any(|token| is_word(token, "by")),
        "unknown" if !is_only => {
            let rest = stream.fork().parse::<TokenStream>().unwrap_or_default();
            !rest.into_iter().any(|token| is_word(&token, "by"))
        }
        "body" => tokens.iter().any(|token| matches!(token, TokenTree::Group(_))),
        _ => true,
    }
}

/// The message of a statement that begins with no keyword.
pub(super) fn without_keyword(word: &str, stream: ParseStream) -> String {
    let tokens = ahead(stream);
    let signs: Vec<char> = tokens
        .iter()
        .filter_map(|token| match token {
            TokenTree::Punct(punct) => Some(punct.as_char()),
            _ => None,
        })
        .collect();
    match (is_punct(tokens.first(), '='), tokens.get(1)) {
        (true, Some(TokenTree::Literal(_))) => format!("expected a keyword before `{word}`: write `param {word} = …;`"),
        (true, _) => format!(
            "expected a keyword before `{word}`: write `point {word} = VECTOR;`, `output {word} = SCALAR;` or `let {word} = …;`"
        ),
        _ if signs.contains(&'@') && signs.contains(&'=') => {
            format!("expected a keyword before `{word}`: write `loop {word}… = …;`")
        }
        _ if scene::EFFECTS.contains(&word) => {
            format!("`{word}` is an effect of a scene: write it into `scene NAME {{ … }}`")
        }
        _ => format!("unknown statement `{word}`\nstatements: {}", KEYWORDS.join(", ")),
    }
}

/// Guesses the kind of a statement from its tokens, including the word instead of a keyword.
pub(super) fn kind(tokens: &[TokenTree], expressions: &mut Expressions) -> StatementKind {
    let [TokenTree::Ident(keyword), rest @ ..] = tokens else { return unread(tokens) };
    let first = rest.first().and_then(name);
    match first {
        Some(_) if is_punct(rest.get(1), '=') && begins_with_number(&rest[2..]) => parameters(rest, expressions),
        None if is_punct(rest.first(), '=') && begins_with_number(&rest[1..]) => parameters(tokens, expressions),
        Some(name) if is_punct(rest.get(1), '=') => {
            StatementKind::Quantity { name, value: unread_value(rest, keyword.span(), expressions) }
        }
        None if is_punct(rest.first(), '=') => {
            StatementKind::Quantity { name: keyword.clone(), value: unread_value(rest, keyword.span(), expressions) }
        }
        _ if tokens.iter().any(|token| is_punct(Some(token), '=')) => {
            let value = |expressions: &mut Expressions| unread_value(tokens, keyword.span(), expressions);
            StatementKind::Loop { left: value(expressions), right: value(expressions), is_implied: false }
        }
        _ => unread(rest),
    }
}

/// True for a number alone or with others after a comma, as parameters have; `2 * P` may be a point.
fn begins_with_number(tokens: &[TokenTree]) -> bool {
    matches!(tokens.first(), Some(TokenTree::Literal(_))) && (tokens.len() == 1 || is_punct(tokens.get(1), ','))
}

/// Guesses a statement with a syntax error from its keyword and the tokens after it.
pub(super) fn of_keyword(keyword: &Ident, rest: &[TokenTree], expressions: &mut Expressions) -> StatementKind {
    if keyword == "implied" {
        // Several of them say no more than one.
        let rest = &rest[rest.iter().take_while(|token| is_word(token, "implied")).count()..];
        let [TokenTree::Ident(what), rest @ ..] = rest else { return unread(rest) };
        return match of_keyword(what, rest, expressions) {
            StatementKind::Loop { left, right, .. } => StatementKind::Loop { left, right, is_implied: true },
            StatementKind::Equation { left, right, .. } => StatementKind::Equation { left, right, is_implied: true },
            other => other,
        };
    }
    let names = || rest.iter().filter_map(name);
    let first = rest.first().and_then(name).filter(|name| name != "by");
    let value = |expressions: &mut Expressions| unread_value(rest, keyword.span(), expressions);
    match (keyword.to_string().as_str(), first) {
        ("param", _) => parameters(rest, expressions),
        ("input", _) => StatementKind::Inputs(declared(rest)),
        ("unknown", _) => StatementKind::Unknowns(declared(rest)),
        ("coordinate", _) => StatementKind::Coordinates(declared(rest)),
        ("derive", _) => StatementKind::Derive(names().collect()),
        ("drive", Some(name)) => {
            let by = names().skip(1).filter(|word| word != "by").collect();
            StatementKind::Drive { name, by }
        }
        ("loop", _) => StatementKind::Loop { left: value(expressions), right: value(expressions), is_implied: false },
        ("equation", _) => {
            StatementKind::Equation { left: value(expressions), right: value(expressions), is_implied: false }
        }
        ("let", Some(name)) => StatementKind::Let { name, value: value(expressions) },
        ("point", Some(name)) => StatementKind::Point { name, value: value(expressions) },
        ("output", Some(name)) => StatementKind::Output { name, range: None, value: value(expressions) },
        ("body", Some(name)) => StatementKind::Body(Body {
            name,
            properties: vec![(keyword.clone(), value(expressions))],
            is_complete: false,
        }),
        ("scene", Some(name)) => {
            let is_of = names().nth(1).is_some_and(|word| word == "of");
            let of = names().nth(2).filter(|_| is_of);
            StatementKind::Scene(Scene { name, of, effects: Vec::new(), is_complete: false })
        }
        ("extern", _) => StatementKind::Unread { names: names().collect(), is_list: false, is_extern: true },
        _ => StatementKind::Unread { names: names().collect(), is_list: false, is_extern: false },
    }
}

/// Coordinates: all names but those of a range, from `in` to the next comma.
fn declared(tokens: &[TokenTree]) -> Vec<Declared> {
    let is_range = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if word == "in");
    let items = tokens.split(|token| is_punct(Some(token), ','));
    items
        .flat_map(|item| item.iter().take_while(|token| !is_range(token)).filter_map(name))
        .map(Declared::from)
        .collect()
}

/// Parameters: each name at the beginning, after a comma or before `=`.
fn parameters(tokens: &[TokenTree], expressions: &mut Expressions) -> StatementKind {
    if let [TokenTree::Group(group)] = tokens {
        return parameters(&group.stream().into_iter().collect::<Vec<_>>(), expressions);
    }
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
    StatementKind::Unread { names: names.collect(), is_list, is_extern: false }
}

pub(super) fn unread_value(tokens: &[TokenTree], keyword: Span, expressions: &mut Expressions) -> ExpressionId {
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

/// Records the keywords of Rust in a statement with a syntax error: where one is meant as a name, its uses are the same
/// mistake.
pub(super) fn record_keywords(tokens: &[TokenTree], expressions: &mut Expressions) {
    let mut levels = vec![tokens.to_vec()];
    while let Some(tokens) = levels.pop() {
        for token in &tokens {
            match token {
                TokenTree::Group(group) => levels.push(group.stream().into_iter().collect()),
                TokenTree::Ident(word) if name(token).is_none() => expressions.add_keyword(word),
                _ => {}
            }
        }
    }
}

/// The token as a name, unless it is a Rust keyword.
fn name(token: &TokenTree) -> Option<Ident> {
    match token {
        TokenTree::Ident(name) => {
            let text = name.to_string();
            (!is_keyword(&text) && can_be_name(&text)).then(|| plain(name.clone()))
        }
        _ => None,
    }
}

fn is_word(token: &TokenTree, text: &str) -> bool {
    matches!(token, TokenTree::Ident(word) if word == text)
}

fn is_punct(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}
