//! The parser: from tokens to a syntax tree of the `linkage!` language, with spans.
//!
//! A statement with a syntax error is reported, and the names that it seems to declare are kept, so that one mistake
//! causes one message and the rest of the mechanism is still checked.

mod attributes;
mod expression;
mod foreign;
mod fragments;
mod head;
mod identifier;
mod items;
mod kind;
mod limits;
mod list;
mod precedence;
mod punctuation;
mod range;
mod recovery;
mod scene;
mod statement;
mod tokens;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::parse::{ParseStream, Parser};

use crate::diagnostics::Diagnostics;
pub use attributes::NO_DEFAULT;
pub(crate) use expression::unknown_unit;
pub use expression::{Expression, ExpressionId, Expressions, Operator, Suffix, Unit, Unread};
pub(crate) use foreign::constant_of_rust;
pub use head::Mechanism;
pub(crate) use identifier::{KEYWORD_AS_NAME, can_be_name, identifier, is_keyword};
pub use kind::{Declared, KEYWORDS, Range, StatementKind};
pub(crate) use limits::excess;
pub use limits::{DEEPEST_NESTING, LONGEST, LONGEST_WORD};
pub use scene::{Attachment, Body, EFFECTS, Effect, EffectKind, Joint, PROPERTIES, Scene};
pub use statement::Statement;

/// Reads every mechanism of one invocation; `diagnostics` are the mistakes outside of all mechanisms.
pub fn parse(input: TokenStream, diagnostics: &mut Diagnostics) -> Vec<Mechanism> {
    if let Some((at, advice)) = excess(&input, LONGEST) {
        diagnostics.error(at, advice);
        return Vec::new();
    }
    let input = fragments::visible(input);
    let mut mechanisms: Vec<Mechanism> = Vec::new();
    let parser = |stream: ParseStream| {
        while !stream.is_empty() {
            match head::mechanism(stream) {
                Ok(mechanism) => mechanisms.push(mechanism),
                Err(error) => {
                    diagnostics.push(error);
                    skip_to_brace(stream);
                }
            }
        }
        Ok(())
    };
    // `syn` reports unparsed tokens, such as those in an attribute, only here; after other errors they are a
    // consequence.
    if let Err(error) = parser.parse2(input)
        && diagnostics.is_empty()
        && mechanisms.iter().all(|mechanism| mechanism.diagnostics.is_empty())
    {
        diagnostics.push(error);
    }
    mechanisms
}

fn skip_to_brace(stream: ParseStream) {
    while let Ok(token) = stream.parse::<TokenTree>() {
        if matches!(&token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace) {
            return;
        }
    }
}
