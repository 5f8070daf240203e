//! Bodies of functions that emission writes by hand. All others are planned, lowered and printed, so that every reader of
//! a program has what computes and what decides.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The functions of a file of `src/emit` whose bodies it writes, and the reason. A name with `#` is one that the file
/// fills in.
const BY_HAND: [(&str, &[&str], &str); 14] = [
    ("conversions", &["#function", "mechanism", "state", "parts"], "columns of numbers from and to structs"),
    ("any_number", &["parameters", "with", "over"], "a column of parameters from and to a mechanism"),
    ("lanes", &["write_parameters", "design"], "given columns from and to the parameters of a mechanism"),
    ("lanes", &["batch", "list"], "structs of columns to lists of columns"),
    ("external", &["#name"], "a call of a user function, at the place where its path resolves"),
    ("reactions", &["each"], "numbers from a struct of forces to a list"),
    ("scene", &["new", "from", "map", "default"], "numbers from and to a scene"),
    ("types/parameters", &["new", "from", "map", "default"], "numbers from and to a mechanism"),
    ("types/by_name", &["from"], "columns of numbers from and to structs"),
    ("types/mod", &["from"], "one struct from another, or from and to a list"),
    ("types/branch", &["new"], "a struct from its fields"),
    ("functions", &["#name"], "the printer of planned functions"),
    ("rust", &[], "the printer of lowered code"),
    ("implementations", &[], "the printer of implementations"),
];

/// The words of Rust that compute, decide or bind, with the files of `src/emit` that may write them.
const WORDS: [&str; 9] = ["let", "if", "else", "match", "for", "while", "loop", "return", "mut"];

/// The words that are written by hand: a conversion takes lists apart.
const WORDS_BY_HAND: [(&str, &[&str]); 6] = [
    ("conversions", &["let"]),
    ("lanes", &["mut"]),
    ("types/by_name", &["let"]),
    ("types/mod", &["let"]),
    ("functions", &["mut"]),
    ("rust", &["let", "else", "if", "return", "mut"]),
];

#[test]
fn no_other_body_is_written_by_hand() {
    let known: BTreeSet<(String, String)> = BY_HAND
        .iter()
        .flat_map(|(file, names, _)| names.iter().map(|name| ((*file).to_owned(), (*name).to_owned())))
        .collect();
    let written: BTreeSet<(String, String)> = emitted()
        .into_iter()
        .flat_map(|(file, quoted)| bodies(&quoted).into_iter().map(move |name| (file.clone(), name)))
        .collect();
    assert_eq!(written, known, "plan a body that computes in src/program, or name a conversion in this list");
}

#[test]
fn no_other_statement_is_written_by_hand() {
    let known = WORDS_BY_HAND.iter().flat_map(|(file, words)| words.iter().map(|word| ((*file).to_owned(), *word)));
    let known: BTreeSet<(String, &str)> = known.collect();
    let mut written = BTreeSet::new();
    for (file, quoted) in emitted() {
        for word in WORDS {
            written.extend(has_word(&quoted, word).then(|| (file.clone(), word)));
        }
    }
    assert_eq!(written, known, "plan a statement in src/program");
}

/// The tokens that each file of `src/emit` writes: the contents of its `quote!` and `quote_spanned!`.
fn emitted() -> Vec<(String, TokenStream)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/emit");
    let mut all = Vec::new();
    for path in files(&folder) {
        let name = path.strip_prefix(&folder).unwrap().with_extension("").display().to_string().replace('\\', "/");
        let mut quoted = Vec::new();
        quotes(fs::read_to_string(&path).unwrap().parse().unwrap(), &mut quoted);
        all.extend(quoted.into_iter().map(|tokens| (name.clone(), tokens)));
    }
    assert!(all.len() > 100, "{} quotes are fewer than there were", all.len());
    all
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let within = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
    paths.flat_map(within).filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect()
}

fn quotes(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (place, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_quote = place >= 2
            && tokens[place - 1].to_string() == "!"
            && ["quote", "quote_spanned"].contains(&tokens[place - 2].to_string().as_str());
        if is_quote { found.push(group.stream()) } else { quotes(group.stream(), found) }
    }
}

/// The names of the functions with a body, also of those in `impl` groups.
fn bodies(tokens: &TokenStream) -> Vec<String> {
    let mut names = Vec::new();
    let mut name: Option<String> = None;
    let mut tokens = tokens.clone().into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Ident(word) if word == "fn" => {
                let is_filled_in = tokens.peek().is_some_and(|next| next.to_string() == "#");
                let sign = if is_filled_in { tokens.next() } else { None };
                name = tokens.next().map(|word| format!("{}{word}", sign.map_or("", |_| "#")));
            }
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace && name.is_some() => {
                names.extend(name.take());
            }
            TokenTree::Group(group) => names.extend(bodies(&group.stream())),
            _ => {}
        }
    }
    names
}

/// True if this keyword is written; the `for` of an `impl` is followed by a type, and its statements by a pattern.
fn has_word(tokens: &TokenStream, word: &str) -> bool {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    tokens.iter().enumerate().any(|(place, token)| match token {
        TokenTree::Group(group) => has_word(&group.stream(), word),
        TokenTree::Ident(other) if other == "for" => {
            word == "for" && tokens[place..].iter().any(|token| token.to_string() == "in")
        }
        // A name that is filled in, such as `#let`.
        TokenTree::Ident(other) => other == word && (place == 0 || tokens[place - 1].to_string() != "#"),
        _ => false,
    })
}
