//! The documentation of emitted items, as rustdoc shows it for the crate of a user.

use std::fs;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::{Expr, File, ImplItem, Item, ItemImpl, Meta, Stmt, Visibility};

/// The expansions of the mechanisms of the gallery, each with its file.
fn expansions() -> Vec<(String, TokenStream)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dev/gallery/src/mechanisms");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let expanded = files.into_iter().filter_map(|path| {
        let tokens: TokenStream = fs::read_to_string(&path).unwrap().parse().unwrap();
        let body = tokens.into_iter().find_map(|token| match token {
            TokenTree::Group(group) if !group.stream().is_empty() => Some(group.stream()),
            _ => None,
        });
        let root: TokenStream = "::linkage".parse().unwrap();
        Some((path.display().to_string(), linkage_compiler::expand(body?, &root)))
    });
    let expanded: Vec<_> = expanded.collect();
    assert!(expanded.len() > 50, "{} files", expanded.len());
    expanded
}

/// The texts of all `#[doc = "…"]`.
fn texts(tokens: TokenStream, found: &mut Vec<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (at, token) in tokens.iter().enumerate() {
        match (token, tokens.get(at + 1), tokens.get(at + 2)) {
            (TokenTree::Ident(doc), Some(TokenTree::Punct(_)), Some(TokenTree::Literal(text))) if doc == "doc" => {
                found.push(syn::parse_str::<syn::LitStr>(&text.to_string()).unwrap().value());
            }
            (TokenTree::Group(group), ..) => texts(group.stream(), found),
            _ => {}
        }
    }
}

/// rustdoc sets primes in plain text as quotation marks.
#[test]
fn derivatives_are_code() {
    for (file, tokens) in expansions() {
        let mut found = Vec::new();
        texts(tokens, &mut found);
        for text in found {
            // Code between fences, and between single marks.
            let prose: String = text.split("```").step_by(2).flat_map(|part| part.split('`').step_by(2)).collect();
            let words = prose.split(|letter: char| !(letter.is_alphanumeric() || letter == '\''));
            // A plural has an apostrophe too.
            let bare: Vec<&str> =
                words.filter(|word| word.contains("''") || (word.len() == 2 && word.ends_with('\''))).collect();
            assert!(bare.is_empty(), "{file}: {bare:?} in {text}");
        }
    }
}

/// The documentation of a binary has private functions too.
#[test]
fn private_functions_are_hidden() {
    let mut hidden = 0;
    for (file, tokens) in expansions() {
        let file_of: File = syn::parse2(tokens).unwrap();
        for block in file_of.items.into_iter().flat_map(blocks) {
            for item in block.items {
                let ImplItem::Fn(function) = item else { continue };
                if block.trait_.is_some() || !matches!(function.vis, Visibility::Inherited) {
                    continue;
                }
                let is_hidden = function.attrs.iter().any(|attribute| {
                    matches!(&attribute.meta, Meta::List(list) if list.path.is_ident("doc") && list.tokens.to_string() == "hidden")
                });
                assert!(is_hidden, "{file}: {}", function.sig.ident);
                hidden += 1;
            }
        }
    }
    assert!(hidden > 100, "{hidden} private functions");
}

/// The `impl` blocks of an item, also those in an anonymous constant.
fn blocks(item: Item) -> Vec<ItemImpl> {
    match item {
        Item::Impl(block) => vec![block],
        Item::Const(constant) => match *constant.expr {
            Expr::Block(inner) => inner
                .block
                .stmts
                .into_iter()
                .flat_map(|statement| match statement {
                    Stmt::Item(item) => blocks(item),
                    _ => Vec::new(),
                })
                .collect(),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}
