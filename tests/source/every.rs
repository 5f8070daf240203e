//! Emitted code of every mechanism and scene of these tests, each with all `derive` requests.

use std::fs;
use std::path::Path;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, Item, Stmt};

/// All `derive` requests; those that a mechanism lacks are added.
const REQUESTS: [&str; 5] = ["limits", "jerk", "velocity_ratio_derivatives", "sensitivity", "intervals"];

/// Folders and files with mechanisms.
const SOURCES: [&str; 3] =
    ["dev/gallery/src/mechanisms", "examples/engine/machine.rs", "examples/door_closer/machine.rs"];

/// One `linkage!`.
pub struct Expansion {
    /// The file and the number of the macro in it.
    pub module: String,
    /// User modules that the mechanism refers to.
    pub functions: String,
    pub emitted: syn::File,
}

/// The expansions of all mechanisms, or of those in the files with these names.
pub fn expansions(root: &Path, chosen: Option<&[&str]>) -> Vec<Expansion> {
    let mut expansions = Vec::new();
    for source in SOURCES {
        let path = root.join(source);
        let mut paths: Vec<_> = if path.is_dir() {
            fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()).collect()
        } else {
            vec![path]
        };
        paths.sort();
        for path in paths {
            let parent = path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let name = if stem == "machine" { parent.into_owned() } else { stem.into_owned() };
            if chosen.is_some_and(|chosen| !chosen.contains(&name.as_str())) {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let file: syn::File = syn::parse_str(&text).unwrap();
            let macros = file.items.iter().filter_map(|item| match item {
                Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(&item.mac.tokens),
                _ => None,
            });
            let functions = file.items.iter().filter(|item| matches!(item, Item::Mod(_)));
            let functions: String = functions.map(|item| item.to_token_stream().to_string()).collect();
            for (number, tokens) in macros.enumerate() {
                let module = format!("{name}_{number}");
                let emitted = syn::parse2(expanded(tokens)).unwrap_or_else(|error| panic!("{module}: {error}"));
                expansions.push(Expansion { module, functions: functions.clone(), emitted });
            }
        }
    }
    expansions
}

/// The emitted code of mechanisms with all `derive` requests.
fn expanded(tokens: &TokenStream) -> TokenStream {
    let text = tokens.to_string();
    let expand = |text: &str| linkage_compiler::expand(text.parse().unwrap(), &"::linkage".parse().unwrap());
    let has_errors = |tokens: &TokenStream| tokens.to_string().contains("compile_error");
    let wanted: Vec<&str> = text.split("derive ").skip(1).filter_map(|rest| rest.split(';').next()).collect();
    let is_wanted = |request: &str| wanted.iter().any(|list| list.split(',').any(|name| name.trim() == request));
    // The first brace is that of the mechanism.
    let with = |requests: &[&str]| text.replacen('{', &format!("{{ derive {};", requests.join(", ")), 1);
    let missing: Vec<&str> = REQUESTS.into_iter().filter(|request| !is_wanted(request)).collect();
    let all = expand(&if missing.is_empty() { text.clone() } else { with(&missing) });
    if !has_errors(&all) {
        return all;
    }
    let allowed: Vec<&str> = missing.into_iter().filter(|request| !has_errors(&expand(&with(&[request])))).collect();
    expand(&if allowed.is_empty() { text.clone() } else { with(&allowed) })
}

/// Every item, also those in the blocks of constants.
pub fn items(items: &[Item]) -> Vec<&Item> {
    let mut all = Vec::new();
    for item in items {
        all.push(item);
        let Item::Const(item) = item else { continue };
        let Expr::Block(block) = &*item.expr else { continue };
        for statement in &block.block.stmts {
            if let Stmt::Item(item) = statement {
                all.extend(self::items(std::slice::from_ref(item)));
            }
        }
    }
    all
}
