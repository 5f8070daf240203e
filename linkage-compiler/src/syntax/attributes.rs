//! The attributes that each construct accepts.

use proc_macro2::TokenTree;
use quote::{ToTokens, quote};
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::token::Bracket;
use syn::{Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue, Path, Token};

use super::kind::{Bearer, at_keyword};
use crate::diagnostics::Diagnostics;

/// Parses the attributes before a construct; one with a syntax error is reported and skipped.
pub(super) fn read(stream: ParseStream, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    let mut attributes = Vec::new();
    while stream.peek(Token![#]) {
        if !stream.peek2(Bracket) {
            diagnostics.error(stream.span(), "`#` begins an attribute, `#[…]`: a comment begins with `//`");
            // Skip the comment.
            while !stream.is_empty() && !stream.peek(Token![;]) && !at_keyword(stream) {
                drop(stream.parse::<TokenTree>());
            }
            continue;
        }
        let ahead = stream.fork();
        match ahead.call(Attribute::parse_outer) {
            Ok(mut read) => {
                attributes.append(&mut read);
                stream.advance_to(&ahead);
            }
            Err(error) => {
                diagnostics.push(error);
                // Skip `#` and its brackets.
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

/// The reason why the types of a mechanism derive no `Default`.
pub const NO_DEFAULT: &str = "`Default` is emitted with the default values of the parameters: remove it here, and give \
    each parameter a value, as in `param a = 2;`";

/// Returns the accepted attributes; reports those that would have no effect or a misleading one.
pub(super) fn meant(mut attributes: Vec<Attribute>, on: Bearer, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    attributes.retain(|attribute| {
        let path = attribute.path();
        let configures = path.is_ident("cfg") || (path.is_ident("cfg_attr") && holds_cfg(attribute));
        let message = if path.is_ident("doc") {
            let has_meaning = if on == Bearer::Part { is_text(attribute) } else { can_be_text(attribute) };
            if has_meaning {
                return true;
            }
            "only a plain doc comment is allowed here".to_owned()
        } else if path.is_ident("deprecated") {
            "`deprecated` would warn in the emitted code itself: put it on a `type` alias instead".to_owned()
        } else if configures && on == Bearer::Mechanism && path.is_ident("cfg_attr") {
            "`cfg_attr` would apply to some of the emitted items only: write `#[cfg(…)]` instead".to_owned()
        } else if configures && on != Bearer::Mechanism {
            "`cfg` does not work on a part of a mechanism: macros run before it is evaluated\nwrite one \
             mechanism for each case, with `#[cfg(…)]` before `mechanism`"
                .to_owned()
        } else if matches!(on, Bearer::Field | Bearer::Part) {
            let name = path.to_token_stream().to_string().replace(' ', "");
            format!("`#[{name}]` has no effect here: only doc comments are allowed")
        } else {
            return true;
        };
        diagnostics.push(syn::Error::new(path.span(), message));
        false
    });
    for attribute in attributes.iter_mut().filter(|attribute| attribute.path().is_ident("derive")) {
        without_default(attribute, diagnostics);
    }
    attributes
}

/// Reports and removes `Default` in a list of traits to derive: the emitted one has the default values of the parameters.
fn without_default(derive: &mut Attribute, diagnostics: &mut Diagnostics) {
    let traits = derive.parse_args_with(Punctuated::<Path, Token![,]>::parse_terminated);
    let (Meta::List(list), Ok(traits)) = (&mut derive.meta, traits) else { return };
    let is_default = |of: &&Path| of.segments.last().is_some_and(|last| last.ident == "Default");
    let (defaults, others): (Vec<&Path>, Vec<&Path>) = traits.iter().partition(is_default);
    if let Some(default) = defaults.first() {
        diagnostics.push(syn::Error::new_spanned(default, NO_DEFAULT));
        list.tokens = quote!(#(#others),*);
    }
}

/// True if it is `doc = "…"`, as a doc comment is.
fn is_text(attribute: &Attribute) -> bool {
    let Meta::NameValue(MetaNameValue { value, .. }) = &attribute.meta else { return false };
    matches!(value, Expr::Lit(ExprLit { lit: Lit::Str(_), .. }))
}

/// True if it is `doc = "…"`, `doc = macro!(…)`, or a setting such as `doc(hidden)`.
fn can_be_text(attribute: &Attribute) -> bool {
    is_text(attribute)
        || match &attribute.meta {
            Meta::NameValue(MetaNameValue { value, .. }) => matches!(value, Expr::Macro(_)),
            Meta::List(_) => true,
            Meta::Path(_) => false,
        }
}

/// True if a `cfg_attr` contains a `cfg`.
fn holds_cfg(attribute: &Attribute) -> bool {
    let Meta::List(list) = &attribute.meta else { return false };
    let after = list.tokens.clone().into_iter().skip_while(|token| !matches!(token, TokenTree::Punct(_)));
    after.into_iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "cfg" || word == "cfg_attr"))
}
