//! Tokens that are written one by one: where there are many, quoting is what unoptimised macros spend
//! their time on.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, TokenStream, TokenTree};
use quote::ToTokens;

use super::names::{comment, ident};

#[derive(Clone)]
pub(super) struct Tokens(Vec<TokenTree>);

impl Default for Tokens {
    /// An empty list with room for what most come to hold.
    fn default() -> Self {
        Self(Vec::with_capacity(16))
    }
}

impl Tokens {
    pub(super) fn with_room_for(count: usize) -> Self {
        Self(Vec::with_capacity(count))
    }

    pub(super) fn append(&mut self, token: impl Into<TokenTree>) {
        self.0.push(token.into());
    }

    pub(super) fn ident(&mut self, ident: &Ident) {
        self.0.push(TokenTree::Ident(ident.clone()));
    }

    pub(super) fn word(&mut self, word: &str) {
        self.0.push(TokenTree::Ident(ident(word)));
    }

    /// `name`
    pub(super) fn name(name: &Ident) -> Self {
        let mut tokens = Self::default();
        tokens.ident(name);
        tokens
    }

    /// `*name`
    pub(super) fn behind(name: &Ident) -> Self {
        let mut tokens = Self::default();
        tokens.punct('*');
        tokens.ident(name);
        tokens
    }

    /// `name<first, second>`
    pub(super) fn of(mut self, arguments: impl IntoIterator<Item = Self>) -> Self {
        self.punct('<');
        for (place, argument) in arguments.into_iter().enumerate() {
            if place > 0 {
                self.punct(',');
            }
            self.join(argument);
        }
        self.punct('>');
        self
    }

    /// `->`
    pub(super) fn arrow(&mut self) {
        self.append(Punct::new('-', Spacing::Joint));
        self.punct('>');
    }

    /// Signs that stand each for itself.
    pub(super) fn punct(&mut self, sign: char) {
        self.0.push(TokenTree::Punct(Punct::new(sign, Spacing::Alone)));
    }

    pub(super) fn group(&mut self, delimiter: Delimiter, inside: Self) {
        self.0.push(TokenTree::Group(Group::new(delimiter, inside.into())));
    }

    pub(super) fn extend(&mut self, stream: TokenStream) {
        self.0.extend(stream);
    }

    /// What another list holds.
    pub(super) fn join(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// `#[doc = "…"]` of all lines together, with the last paragraph if there is one.
    pub(super) fn doc(&mut self, lines: &[String], last: &str) {
        let mut text = String::new();
        let mut line = |line: &str| {
            if !text.is_empty() {
                text.push('\n');
            }
            if !line.is_empty() {
                text.push(' ');
                text.push_str(line);
            }
        };
        for each in lines {
            line(each);
        }
        if !last.is_empty() {
            line("");
            line(last);
        }
        let mut doc = Self::default();
        doc.word("doc");
        doc.punct('=');
        doc.append(comment(&text));
        self.punct('#');
        self.group(Delimiter::Bracket, doc);
    }

    /// The identifier behind `fn`.
    pub(super) fn name_of_function(&self) -> String {
        let mut words = self.0.iter().skip_while(|token| !matches!(token, TokenTree::Ident(word) if word == "fn"));
        words.nth(1).map(ToString::to_string).unwrap_or_default()
    }
}

impl ToTokens for Tokens {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(self.0.iter().cloned());
    }
}

impl From<Literal> for Tokens {
    fn from(literal: Literal) -> Self {
        Self(vec![TokenTree::Literal(literal)])
    }
}

impl From<TokenStream> for Tokens {
    fn from(stream: TokenStream) -> Self {
        Self(stream.into_iter().collect())
    }
}

impl From<Tokens> for TokenStream {
    fn from(tokens: Tokens) -> Self {
        tokens.0.into_iter().collect()
    }
}
