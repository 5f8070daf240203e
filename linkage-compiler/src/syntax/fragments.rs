//! Fragments of other macros, such as `$x:expr`, which come in invisible delimiters.
//!
//! A parser may look through these delimiters, so that `2 * $x` with `10 + 5` would be `2 * 10 + 5`. A fragment with an
//! operator is in parentheses instead, any other is its tokens.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

/// The tokens without invisible delimiters.
pub(super) fn visible(input: TokenStream) -> TokenStream {
    if !is_invisible(&input) {
        return input;
    }
    let mut tokens = TokenStream::new();
    for token in input {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                let inner = visible(group.stream());
                if has_operator(&inner) {
                    tokens.extend([with_content(&group, Delimiter::Parenthesis, inner)]);
                } else {
                    tokens.extend(inner);
                }
            }
            TokenTree::Group(group) if is_invisible(&group.stream()) => {
                tokens.extend([with_content(&group, group.delimiter(), visible(group.stream()))]);
            }
            // A group that is made anew has one span for both its ends.
            other => tokens.extend([other]),
        }
    }
    tokens
}

/// True if an invisible group is among the tokens, at any depth.
fn is_invisible(tokens: &TokenStream) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::None || is_invisible(&group.stream()),
        _ => false,
    })
}

fn has_operator(tokens: &TokenStream) -> bool {
    let is_operator = |token| matches!(token, TokenTree::Punct(punct) if "+-*/^@".contains(punct.as_char()));
    tokens.clone().into_iter().any(is_operator)
}

fn with_content(group: &Group, delimiter: Delimiter, content: TokenStream) -> TokenTree {
    let mut made = Group::new(delimiter, content);
    made.set_span(group.span());
    made.into()
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use super::*;

    fn fragment(tokens: TokenStream) -> TokenTree {
        Group::new(Delimiter::None, tokens).into()
    }

    #[test]
    fn an_expression_stays_one_operand() {
        let sum = fragment(quote!(10 + 5));
        let nested = fragment(quote!(-#sum));
        for (input, expected) in [
            (quote!(2 * #sum), "2 * (10 + 5)"),
            (quote!((u / #sum, x)), "(u / (10 + 5) , x)"),
            (quote!(-#nested), "- (- (10 + 5))"),
        ] {
            assert_eq!(visible(input).to_string(), expected.parse::<TokenStream>().unwrap().to_string());
        }
    }

    #[test]
    fn other_fragments_are_their_tokens() {
        let (literal, visibility, call) =
            (fragment(quote!(30deg)), fragment(quote!(pub(crate))), fragment(quote!(sin(a + b))));
        let found = visible(quote!(#visibility mechanism M { param a = #literal; let x = #call^2; }));
        assert_eq!(
            found.to_string(),
            quote!(pub(crate) mechanism M { param a = 30deg; let x = sin(a + b)^2; }).to_string()
        );
    }
}
