//! The mechanisms as text.

use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::{File, Item};

use crate::{FILES, TEXTS};

/// The folder of the mechanisms.
#[must_use]
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/mechanisms")
}

/// The text of a file of the folder, named without its ending.
///
/// # Panics
/// If there is no such file.
#[must_use]
pub fn text_of(file: &str) -> &'static str {
    let place = FILES.iter().position(|other| *other == file).unwrap_or_else(|| panic!("{file} is no mechanism"));
    TEXTS[place]
}

/// The tokens between the braces of the one `linkage!` of a file.
///
/// # Panics
/// If there is no such file, or if it does not hold exactly one `linkage!`.
#[must_use]
pub fn tokens_of(file: &str) -> TokenStream {
    let parsed = syn::parse_str(text_of(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    tokens_in(&parsed).unwrap_or_else(|| panic!("{file} must hold exactly one linkage!"))
}

/// The tokens between the braces of the `linkage!` of a source file, if there is exactly one.
#[must_use]
pub fn tokens_in(file: &File) -> Option<TokenStream> {
    let mut macros = file.items.iter().filter_map(|item| match item {
        Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens.clone()),
        _ => None,
    });
    macros.next().filter(|_| macros.next().is_none())
}

/// A mechanism with those of its statements that `keep` accepts, each given as text without its doc comments.
#[must_use]
pub fn with_statements(mechanism: TokenStream, keep: impl Fn(&str) -> bool) -> TokenStream {
    let mut tokens: Vec<TokenTree> = mechanism.into_iter().collect();
    let body = tokens.iter_mut().rev().find_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
        _ => None,
    });
    if let Some(body) = body {
        let kept = statements(body.stream())
            .into_iter()
            .filter(|statement| keep(&undocumented(statement.clone()).to_string()));
        *body = Group::new(Delimiter::Brace, kept.collect());
    }
    tokens.into_iter().collect()
}

/// The statements of a body: each ends in a semicolon or in braces.
fn statements(body: TokenStream) -> Vec<TokenStream> {
    let (mut statements, mut statement) = (Vec::new(), Vec::new());
    for token in body {
        let ends = match &token {
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            _ => false,
        };
        statement.push(token);
        if ends {
            statements.push(statement.drain(..).collect());
        }
    }
    statements
}

/// A statement without its attributes, which doc comments are.
fn undocumented(statement: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = statement.into_iter().collect();
    let is_attribute =
        |pair: &[TokenTree]| matches!(pair, [TokenTree::Punct(hash), TokenTree::Group(_)] if hash.as_char() == '#');
    let attributes = tokens.chunks(2).take_while(|pair| is_attribute(pair)).count();
    tokens.into_iter().skip(2 * attributes).collect()
}
