//! The attributes that each construct accepts.

use proc_macro2::TokenTree;
use quote::{ToTokens, quote};
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::token::Bracket;
use syn::{AttrStyle, Attribute, Expr, ExprLit, Lit, Meta, MetaNameValue, Path, Token};

use super::kind::{Bearer, at_keyword};
use super::limits::DEEPEST_NESTING;
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
        let read = match long_value(stream) {
            Some(error) => Err(error),
            None => one(&ahead),
        };
        match read {
            Ok(attribute) => {
                attributes.push(attribute);
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

/// Parses one attribute. After one with a mistake the others are not read again.
fn one(stream: ParseStream) -> syn::Result<Attribute> {
    let content;
    Ok(Attribute {
        pound_token: stream.parse()?,
        style: AttrStyle::Outer,
        bracket_token: syn::bracketed!(content in stream),
        meta: content.parse()?,
    })
}

/// The message of an attribute whose value, after `=`, has more tokens than nested parentheses may have levels: `syn` reads it
/// as an expression, and may take a level of the stack for each token.
fn long_value(stream: ParseStream) -> Option<syn::Error> {
    let ahead = stream.fork();
    ahead.parse::<TokenTree>().ok()?;
    let Ok(TokenTree::Group(group)) = ahead.parse::<TokenTree>() else { return None };
    let is_equality = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == '=');
    let value = group.stream().into_iter().skip_while(|token| !is_equality(token)).skip(1);
    let mut levels: Vec<TokenTree> = value.collect();
    let first = levels.first()?.span();
    let mut count = 0;
    while let Some(token) = levels.pop() {
        count += 1;
        if count > DEEPEST_NESTING {
            return Some(syn::Error::new(first, "the value of an attribute is one text or one macro"));
        }
        if let TokenTree::Group(group) = token {
            levels.extend(group.stream());
        }
    }
    None
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
    let paths =
        |stream: ParseStream| Punctuated::<Path, Token![,]>::parse_terminated_with(stream, Path::parse_mod_style);
    let traits = derive.parse_args_with(paths);
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
