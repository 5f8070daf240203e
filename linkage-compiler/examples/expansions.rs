//! Writes what the compiler makes of every mechanism of the repository, for a comparison before and after a change:
//! `cargo run --release -p linkage-compiler --example expansions -- FOLDER [PART]`, and `diff -r` of two folders. With `PART`
//! only files with this part in their path are read.
//!
//! Each mechanism is expanded as it is written and with all `derive` requests. Its file has the expansion, the programs
//! and the FPCore of both, and the stub; `DERIVATION` has a file of its own. The last line is a hash of each kind.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs};

use linkage_compiler::model::Request;
use linkage_report::Notation;
use linkage_report::lend::Lender;
use linkage_runtime::derivation::{Kernel, KernelCode};
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::quote;

/// Folders with mechanisms.
const SOURCES: [&str; 4] = ["dev/gallery/src/mechanisms", "examples", "tests", "benches"];

fn main() {
    let mut arguments = env::args().skip(1);
    let out = PathBuf::from(arguments.next().expect("a folder to write to"));
    let part = arguments.next().unwrap_or_default();
    fs::create_dir_all(&out).expect("a folder to write to");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut hashes: BTreeMap<&str, (usize, DefaultHasher)> = BTreeMap::new();
    for path in SOURCES.iter().flat_map(|source| files(&root.join(source))) {
        if !path.to_string_lossy().contains(&part) {
            continue;
        }
        let Ok(tokens) = fs::read_to_string(&path).unwrap().parse::<TokenStream>() else { continue };
        let mut bodies = Vec::new();
        invocations(tokens, &mut bodies);
        let name = path.strip_prefix(&root).unwrap().with_extension("").display().to_string().replace(['/', '\\'], "-");
        for (number, body) in bodies.into_iter().enumerate() {
            let mut texts: BTreeMap<&str, String> = BTreeMap::new();
            let all = with_requests(body.clone());
            // A macro that writes mechanisms, or a mistake that a test makes, has no expansion.
            [body, all].into_iter().filter(has_expansion).for_each(|body| write(body, &mut texts));
            for (kind, text) in texts {
                let (bytes, hash) = hashes.entry(kind).or_default();
                *bytes += text.len();
                text.hash(hash);
                fs::write(out.join(format!("{name}-{number}.{kind}")), text).unwrap();
            }
        }
    }
    for (kind, (bytes, hash)) in hashes {
        println!("{kind:12} {bytes:9} bytes, hash {:016x}", hash.finish());
    }
}

/// All Rust files in a folder and in its folders.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let within = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
    paths.into_iter().flat_map(within).filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect()
}

/// The bodies of all `linkage! { … }`, also of those in functions and modules.
fn invocations(tokens: TokenStream, found: &mut Vec<TokenStream>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (place, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_call = place >= 2 && tokens[place - 1].to_string() == "!" && tokens[place - 2].to_string() == "linkage";
        if is_call && group.delimiter() == Delimiter::Brace {
            found.push(group.stream());
        } else {
            invocations(group.stream(), found);
        }
    }
}

/// The body with all requests that its mechanisms can have.
fn with_requests(body: TokenStream) -> TokenStream {
    Request::ALL.iter().fold(body, |body, (keyword, _)| {
        let keyword = Ident::new(keyword, Span::call_site());
        let requested = with_statement(body.clone(), &quote!(derive #keyword;));
        if has_expansion(&requested) { requested } else { body }
    })
}

fn has_expansion(body: &TokenStream) -> bool {
    !linkage_compiler::expand(body.clone(), &quote!(::linkage)).to_string().contains("compile_error !")
}

/// The body of an invocation with a statement at the end of each mechanism.
fn with_statement(body: TokenStream, statement: &TokenStream) -> TokenStream {
    let longer = |token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
            let inside = group.stream();
            TokenTree::Group(Group::new(Delimiter::Brace, quote!(#inside #statement)))
        }
        token => token,
    };
    body.into_iter().map(longer).collect()
}

/// Adds the texts of an invocation, by kind.
fn write(body: TokenStream, texts: &mut BTreeMap<&'static str, String>) {
    let root = quote!(::linkage);
    let (derivation, expansion) = apart(linkage_compiler::expand(body.clone(), &root));
    add(texts, "code", &expansion);
    add(texts, "derivation", &derivation);
    for mechanism in linkage_compiler::read(body).unwrap() {
        add(texts, "stub", &linkage_compiler::emit::stub(&mechanism, &root));
        *texts.entry("program").or_default() += &linkage_compiler::programs(&mechanism).unwrap().concat();
        let lender = Lender::default();
        let (documents, scenes) = linkage_compiler::documents(&mechanism).unwrap();
        let fpcore = texts.entry("fpcore").or_default();
        for document in &documents {
            let derivation = lender.derivation(document).unwrap();
            code(fpcore, derivation.mechanism, derivation.kernels);
            for scene in scenes.iter().filter(|scene| scene.record.mechanism == document.record.mechanism) {
                let scene = lender.scene(scene).unwrap();
                code(fpcore, scene.scene, scene.kernels);
            }
        }
        let _ = writeln!(texts.entry("bounds").or_default(), "{:#?}", linkage_compiler::bounds(&mechanism).unwrap());
    }
}

/// Adds the formulas of functions, a line each.
fn code(text: &mut String, of: &str, kernels: &[Kernel<'_>]) {
    for Kernel { function, code: KernelCode { steps, checks, results }, .. } in kernels {
        if results.is_empty() {
            continue;
        }
        *text += &format!("{of}::{function}\n");
        for step in *steps {
            *text += &format!("let {} {}\n", step.left.to_fpcore(), step.right.to_fpcore());
        }
        for check in *checks {
            let word = format!("{check:?}").to_lowercase();
            let word = word.split('(').next().unwrap_or_default();
            let of: Vec<String> = check.of().iter().map(Notation::to_fpcore).collect();
            *text += &format!("check {word} {}\n", of.join(" "));
        }
        for result in *results {
            *text += &format!("return {} {}\n", result.place, result.value.to_fpcore());
        }
        *text += "\n";
    }
}

fn add(texts: &mut BTreeMap<&'static str, String>, kind: &'static str, tokens: &TokenStream) {
    lines(tokens.clone(), texts.entry(kind).or_default());
}

/// The constants `DERIVATION`, and everything else.
fn apart(tokens: TokenStream) -> (TokenStream, TokenStream) {
    let (mut derivation, mut others) = (TokenStream::new(), TokenStream::new());
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        if token.to_string() == "const" && tokens.peek().is_some_and(|next| next.to_string() == "DERIVATION") {
            derivation.extend(tokens.by_ref().take_while(|token| token.to_string() != ";"));
            continue;
        }
        match token {
            TokenTree::Group(group) => {
                let (inside, rest) = apart(group.stream());
                derivation.extend(inside);
                others.extend([TokenTree::Group(Group::new(group.delimiter(), rest))]);
            }
            token => others.extend([token]),
        }
    }
    (derivation, others)
}

/// Tokens with a line for each statement and each brace.
fn lines(tokens: TokenStream, text: &mut String) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Brace => ["{\n", "\n}\n"],
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::None => ["", ""],
                };
                text.push_str(open);
                lines(group.stream(), text);
                text.push_str(close);
            }
            TokenTree::Punct(punct) => {
                text.push(punct.as_char());
                text.push_str(if matches!(punct.as_char(), ';' | ',') { "\n" } else { " " });
            }
            token => {
                let _ = write!(text, "{token} ");
            }
        }
    }
}
