//! The documentation of emitted items, as rustdoc shows it for the crate of a user.

use std::fs;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::{Expr, File, ImplItem, ImplItemFn, Item, ItemImpl, Meta, Stmt, Visibility};

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

/// rustdoc sets primes in plain text as quotation marks, so that derivatives are code. The documentation of a binary has
/// private functions too, so that they are hidden.
#[test]
fn derivatives_are_code_and_private_functions_hidden() {
    let mut hidden = 0;
    for (file, tokens) in expansions() {
        let mut found = Vec::new();
        texts(tokens.clone(), &mut found);
        for text in found {
            let bare = bare_primes(&text);
            assert!(bare.is_empty(), "{file}: {bare:?} in {text}");
        }
        let file_of: File = syn::parse2(tokens).unwrap();
        for function in file_of.items.into_iter().flat_map(blocks).flat_map(private) {
            assert!(is_hidden(&function), "{file}: {}", function.sig.ident);
            hidden += 1;
        }
    }
    assert!(hidden > 100, "{hidden} private functions");
}

/// The derivatives outside of code.
fn bare_primes(text: &str) -> Vec<String> {
    // Code is between fences, and between single marks.
    let prose: Vec<&str> = text.split("```").step_by(2).flat_map(|part| part.split('`').step_by(2)).collect();
    let prose = prose.join(" ");
    let words = prose.split(|letter: char| !(letter.is_alphanumeric() || letter == '\''));
    // A plural has an apostrophe too.
    let is_bare = |word: &&str| word.contains("''") || (word.chars().count() == 2 && word.ends_with('\''));
    words.filter(is_bare).map(str::to_owned).collect()
}

#[test]
fn bare_primes_are_found() {
    assert_eq!(bare_primes("From q'' and the inputs' v', by `W v'`.\n```text\nu' = W v'\n```"), ["q''", "v'"]);
}

/// The private functions of a block that implements no trait.
fn private(block: ItemImpl) -> impl Iterator<Item = ImplItemFn> {
    let is_own = block.trait_.is_none();
    block.items.into_iter().filter(move |_| is_own).filter_map(|item| match item {
        ImplItem::Fn(function) if matches!(function.vis, Visibility::Inherited) => Some(function),
        _ => None,
    })
}

fn is_hidden(function: &ImplItemFn) -> bool {
    function.attrs.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("doc") && list.tokens.to_string() == "hidden",
        _ => false,
    })
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
