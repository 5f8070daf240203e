//! Names as the user wrote them, and in snake case as fields.

use proc_macro2::{Ident, Span};

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

    /// True if the field is a Rust keyword: `Box` is the field `box`.
    pub(super) fn is_keyword(&self) -> bool {
        // `gen` is one since edition 2024.
        self.field == "gen" || syn::parse_str::<Ident>(&self.field).is_err()
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
