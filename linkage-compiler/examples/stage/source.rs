//! The mechanisms of a file.

use std::fs;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The bodies of all `linkage! { … }` of a file, or the file itself if it has none and begins with a mechanism.
pub fn bodies(file: &str) -> Result<Vec<TokenStream>, String> {
    let text = fs::read_to_string(file)
        .map_err(|error| format!("{file}: {error}; write the path of a Rust file with `linkage! {{ … }}`"))?;
    let tokens: TokenStream =
        text.parse().map_err(|error| format!("{file} is not read: {error}; write the path of a Rust file"))?;
    let mut found = Vec::new();
    invocations(tokens.clone(), &mut found);
    if found.is_empty() {
        let is_mechanism = |token: TokenTree| matches!(token, TokenTree::Ident(word) if word == "mechanism");
        if !tokens.clone().into_iter().any(is_mechanism) {
            return Err(without_mechanism(file));
        }
        found.push(tokens);
    }
    Ok(found)
}

/// The bodies of all `linkage! { … }`, also of those in functions and modules.
fn invocations(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (index, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_call = index >= 2 && tokens[index - 1].to_string() == "!" && tokens[index - 2].to_string() == "linkage";
        if is_call && group.delimiter() == Delimiter::Brace {
            found.push(group.stream());
        } else {
            invocations(group.stream(), found);
        }
    }
}

pub fn without_mechanism(file: &str) -> String {
    format!("{file} has no mechanism: write the path of a file with `linkage! {{ … }}`")
}
