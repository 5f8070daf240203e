//! `mechanism NAME { … }`.

use proc_macro2::{Ident, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Attribute, Token, Visibility};

use super::attributes;
use super::expression::Expressions;
use super::identifier::{can_be_name, plain};
use super::kind::Bearer;
use super::statement::{self, Statement};
use super::tokens::name;
use crate::diagnostics::{Diagnostics, Region};

/// One `mechanism NAME { … }`.
pub struct Mechanism {
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub statements: Vec<Statement>,
    pub expressions: Expressions,
    /// Its syntax errors.
    pub diagnostics: Diagnostics,
}

const FORM: &str = "mechanism NAME { … }";

pub(super) fn mechanism(stream: ParseStream) -> syn::Result<Mechanism> {
    let mut diagnostics = Diagnostics::default();
    let attributes = attributes::read(stream, &mut diagnostics);
    let attributes = attributes::meant(attributes, Bearer::Mechanism, &mut diagnostics);
    let visibility = stream.parse()?;
    if let Ok(sign) = stream.parse::<Token![;]>() {
        return Err(syn::Error::new(sign.span, "remove this `;`: a mechanism ends with its braces"));
    }
    let keyword: Ident =
        stream.call(Ident::parse_any).map_err(|error| syn::Error::new(error.span(), format!("expected `{FORM}`")))?;
    let is_nameless = keyword != "mechanism" && stream.peek(syn::token::Brace);
    if keyword != "mechanism" {
        let error = syn::Error::new(keyword.span(), format!("expected `{FORM}`, found `{keyword}`"));
        let is_named = stream.peek(syn::Ident) && stream.peek2(syn::token::Brace);
        if !(is_named || is_nameless && can_be_name(&keyword.to_string())) {
            return Err(error);
        }
        diagnostics.push(error);
    }
    let name = if is_nameless {
        plain(keyword)
    } else if stream.fork().call(Ident::parse_any).is_ok() {
        name(stream)?
    } else {
        let found = if stream.is_empty() { keyword.span() } else { stream.span() };
        return Err(syn::Error::new(found, format!("expected a name: `{FORM}`")));
    };
    match before_braces(stream, &name) {
        Some(error) if stream.is_empty() => {
            diagnostics.push(error);
            return Ok(empty(attributes, visibility, name, diagnostics));
        }
        Some(error) => diagnostics.push(error),
        None => {}
    }
    let content;
    syn::braced!(content in stream);
    let mut expressions = Expressions::default();
    let statements = statement::statements(&content, &mut expressions, &mut diagnostics);
    Ok(Mechanism { attributes, visibility, name, statements, expressions, diagnostics })
}

/// Skips the tokens between the name and the braces; they are a mistake.
fn before_braces(stream: ParseStream, name: &Ident) -> Option<syn::Error> {
    if stream.peek(syn::token::Brace) {
        return None;
    }
    let missing = format!("expected `{{` after `{name}`");
    if stream.is_empty() {
        return Some(syn::Error::new(name.span(), missing));
    }
    let is_generic = stream.peek(Token![<]);
    let mut region: Option<Region> = None;
    while !stream.is_empty() && !stream.peek(syn::token::Brace) {
        let Ok(token) = stream.parse::<TokenTree>() else { break };
        region = Some(region.map_or(token.span().into(), |region| region.to(token.span().into())));
    }
    let message = match is_generic {
        true => {
            format!("a mechanism has no generic parameters: write `mechanism {name} {{ … }}`; its scalar type is `T`")
        }
        false => missing,
    };
    region.map(|region| syn::Error::new_spanned(region, message))
}

/// A mechanism without braces.
fn empty(attributes: Vec<Attribute>, visibility: Visibility, name: Ident, diagnostics: Diagnostics) -> Mechanism {
    let (statements, expressions) = (Vec::new(), Expressions::default());
    Mechanism { attributes, visibility, name, statements, expressions, diagnostics }
}
