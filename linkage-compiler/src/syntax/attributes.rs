//! Attributes: which have a meaning where.

use proc_macro2::TokenTree;
use quote::ToTokens;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::spanned::Spanned;
use syn::token::Bracket;
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue, Token};

use crate::diagnostics::Diagnostics;

/// The construct that an attribute belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bearer {
    /// A mechanism, all of whose items may be configured out together.
    Mechanism,
    /// A part of a mechanism that becomes a type, or a field of the type of the parameters.
    Item,
    /// A field of types that the macro alone defines.
    Field,
    /// A part that becomes nothing that could bear it; a doc comment is for the reader.
    Part,
}

/// The attributes before something; one that does not parse is reported and skipped.
pub(super) fn read(stream: ParseStream, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    let mut attributes = Vec::new();
    while stream.peek(Token![#]) {
        let ahead = stream.fork();
        match ahead.call(Attribute::parse_outer) {
            Ok(mut read) => {
                attributes.append(&mut read);
                stream.advance_to(&ahead);
            }
            Err(error) => {
                diagnostics.push(error);
                // The sign and its brackets.
                for _ in 0..2 {
                    if stream.peek(Token![#]) || stream.peek(Bracket) {
                        drop(stream.parse::<TokenTree>());
                    }
                }
            }
        }
    }
    attributes
}

/// The attributes that have a meaning; those that would have no effect, or another one than somebody means, are
/// refused.
pub(super) fn meant(mut attributes: Vec<Attribute>, on: Bearer, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    attributes.retain(|attribute| {
        let path = attribute.path();
        let configures = path.is_ident("cfg") || (path.is_ident("cfg_attr") && holds_cfg(attribute));
        let message = if path.is_ident("doc") {
            let has_meaning = if on == Bearer::Part { is_text(attribute) } else { can_be_text(attribute) };
            if has_meaning {
                return true;
            }
            "a doc comment has text alone here".to_owned()
        } else if path.is_ident("deprecated") {
            "emitted code itself uses what is declared here and would warn: mark a `type` alias of it".to_owned()
        } else if configures && on == Bearer::Mechanism && path.is_ident("cfg_attr") {
            "write `#[cfg(…)]` itself: a `cfg_attr` would reach only some of the items emitted".to_owned()
        } else if configures && on != Bearer::Mechanism {
            "a part of a mechanism cannot be configured out: the macro runs before `cfg` is evaluated\nwrite one \
             mechanism for each case, with the `#[cfg(…)]` before the word `mechanism`"
                .to_owned()
        } else if matches!(on, Bearer::Field | Bearer::Part) {
            let name = path.to_token_stream().to_string().replace(' ', "");
            format!("`#[{name}]` has no effect here: this takes doc comments alone")
        } else {
            return true;
        };
        diagnostics.push(syn::Error::new(path.span(), message));
        false
    });
    attributes
}

/// True if it is text, as a comment is.
fn is_text(attribute: &Attribute) -> bool {
    let Meta::NameValue(MetaNameValue { value, .. }) = &attribute.meta else { return false };
    matches!(value, Expr::Lit(ExprLit { lit: Lit::Str(_), .. }))
}

/// True if it is text, or a macro that gives text, or a setting such as `doc(hidden)`.
fn can_be_text(attribute: &Attribute) -> bool {
    is_text(attribute)
        || match &attribute.meta {
            Meta::NameValue(MetaNameValue { value, .. }) => matches!(value, Expr::Macro(_)),
            Meta::List(_) => true,
            Meta::Path(_) => false,
        }
}

/// True if a `cfg_attr` makes a `cfg`.
fn holds_cfg(attribute: &Attribute) -> bool {
    let Meta::List(list) = &attribute.meta else { return false };
    let after = list.tokens.clone().into_iter().skip_while(|token| !matches!(token, TokenTree::Punct(_)));
    after.into_iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "cfg" || word == "cfg_attr"))
}
