use proc_macro2::{TokenStream, TokenTree};
use std::collections::BTreeMap;
fn count(s: TokenStream) -> usize {
    s.into_iter()
        .map(|t| match t {
            TokenTree::Group(g) => 1 + count(g.stream()),
            _ => 1,
        })
        .sum()
}
fn main() {
    let file = include_str!("../tests/mechanisms/four_bar.rs");
    let (open, close) = (file.find('{').map_or(0, |at| at + 1), file.rfind('}').unwrap_or(file.len()));
    let root: TokenStream = "::linkage".parse().expect("a path");
    let tokens: TokenStream = file[open..close].parse().expect("tokens");
    let out = linkage_compiler::expand(tokens, &root);
    println!("{} bytes {}", count(out.clone()), out.to_string().len());
    fn walk(s: TokenStream, by: &mut BTreeMap<String, usize>, depth: usize) {
        let mut label = String::new();
        let mut prev = String::new();
        let mut acc = 0;
        for t in s {
            let text = match &t {
                TokenTree::Ident(i) => i.to_string(),
                _ => String::new(),
            };
            if ["fn", "struct", "impl", "const", "static", "trait"].contains(&prev.as_str())
                && !text.is_empty()
                && (label.is_empty() || prev == "fn")
            {
                label = format!("{prev} {text}");
            }
            if prev == "for" && label.starts_with("impl") {
                label = format!("{label} for {text}");
            }
            prev = text.clone();
            match t {
                TokenTree::Group(g) => {
                    let n = 1 + count(g.stream());
                    acc += n;
                    if g.delimiter() == proc_macro2::Delimiter::Brace
                        && depth < 3
                        && n > 400
                        && !label.starts_with("fn")
                    {
                        walk(g.stream(), by, depth + 1);
                        acc = 0;
                        label.clear();
                    } else if g.delimiter() == proc_macro2::Delimiter::Brace {
                        *by.entry(if label.is_empty() { "?".into() } else { label.clone() }).or_default() += acc;
                        acc = 0;
                        label.clear();
                    }
                }
                _ => acc += 1,
            }
        }
        *by.entry(format!("rest {depth} {label}")).or_default() += acc;
    }
    let mut by = BTreeMap::new();
    walk(out, &mut by, 0);
    let mut v: Vec<_> = by.into_iter().collect();
    v.sort_by_key(|x| std::cmp::Reverse(x.1));
    for (k, n) in v.iter().take(70) {
        println!("{n:6} {k}");
    }
}
