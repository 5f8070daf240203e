//! Names as the user wrote them, in snake case as fields, and as identifiers.

use std::fmt;

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;

use crate::syntax::{identifier, is_keyword};

/// The name of a type: of a mechanism, a driver or a scene. As text it is `type`, as a token `r#type`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TypeName(Ident);

impl TypeName {
    pub(super) fn new(name: &Ident) -> Self {
        Self(name.clone())
    }

    #[must_use]
    pub fn span(&self) -> Span {
        self.0.span()
    }
}

impl fmt::Display for TypeName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl ToTokens for TypeName {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        identifier(&self.to_string(), self.span()).to_tokens(tokens);
    }
}

impl PartialEq<str> for TypeName {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl PartialEq<&str> for TypeName {
    fn eq(&self, other: &&str) -> bool {
        *self == **other
    }
}

impl PartialEq<Ident> for TypeName {
    fn eq(&self, other: &Ident) -> bool {
        self.0 == *other
    }
}

/// A name of the mechanism.
#[derive(Debug, Clone)]
pub struct Name {
    /// The name as written.
    pub text: String,
    /// The name in snake case: the point `G3` is the field `g3`.
    pub field: String,
    pub span: Span,
}

impl Name {
    pub(super) fn new(ident: &Ident) -> Self {
        let text = ident.to_string();
        Self { field: snake_case(&text), text, span: ident.span() }
    }

    /// True if the field is a Rust keyword and the name is not: `Box` is the field `box`. The user wrote the name `r#box` as
    /// such, and so it is in Rust.
    pub(super) fn becomes_keyword(&self) -> bool {
        self.field != self.text && is_keyword(&self.field)
    }

    /// The field as an identifier.
    pub(crate) fn identifier(&self, index: Span) -> Ident {
        identifier(&self.field, index)
    }
}

/// `G3` is `g3`, `CouplerPoint` is `coupler_point`, `AB` is `ab`.
fn snake_case(text: &str) -> String {
    let mut field = String::new();
    let mut after_lower = false;
    for letter in text.chars() {
        if letter.is_uppercase() && after_lower {
            field.push('_');
        }
        after_lower = letter.is_lowercase();
        field.extend(letter.to_lowercase());
    }
    field
}

#[cfg(test)]
mod tests {
    use super::snake_case;

    #[test]
    fn fields_are_snake_case() {
        for (text, field) in
            [("G3", "g3"), ("CouplerPoint", "coupler_point"), ("AB", "ab"), ("theta2", "theta2"), ("_x", "_x")]
        {
            assert_eq!(snake_case(text), field);
        }
    }
}
