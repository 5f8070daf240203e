//! Docs, comments and messages use the standard terms, one word for one idea, and a doc comment begins with a sentence or a
//! noun phrase that names the thing.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// Words that readers would have to decode, and what to write instead. A rule that ends in `*` holds for all words that
/// begin so.
const BANNED: [(&str, &str); 31] = [
    ("beside", "relative to, divided by; next to"),
    ("roundings", "ulps, rounding errors"),
    ("closure", "loop equation, constraint; residual"),
    ("closures", "loop equations, constraints; residuals"),
    ("verdict*", "check, test, error"),
    ("judge*", "check, test"),
    ("judging", "checking"),
    ("refuse*", "reject, return an error"),
    ("refusal*", "error"),
    ("refusing", "rejecting"),
    ("road", "method, algorithm"),
    ("roads", "methods, algorithms"),
    ("stand on", "depend on, require"),
    ("stands on", "depends on, requires"),
    ("stood on", "depended on"),
    ("hostile", "extreme, invalid, degenerate"),
    ("hopeless", "extreme, invalid, degenerate"),
    ("of the user's", "user function, the user's .."),
    ("word of rust", "keyword"),
    ("words and signs", "tokens"),
    ("what is left", "residual, remainder"),
    ("leaves over", "residual, remainder"),
    ("left over", "residual, remainder"),
    ("nought", "zero"),
    ("mood", "say what varies"),
    ("nobody", "say who"),
    ("whoever", "say who"),
    ("whichever", "say which"),
    ("are words of rust", "are keywords"),
    ("told apart", "distinguished"),
    ("tell apart", "distinguish"),
];

/// Words with which no doc comment begins: it would begin in the middle of a thought.
const FIRST: [&str; 10] =
    ["What ", "Where ", "Whether ", "Which ", "Whichever ", "Whose ", "How ", "Of ", "As ", "The same "];

/// Where a banned word is right: the end of a path, and the text around the word.
const ALLOWED: [(&str, &str); 2] =
    [("rack_steering.rs", "Road Vehicle Suspensions"), ("firmware/main.rs", "a Rust closure")];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let ends = path.extension().unwrap_or_default();
        if path.is_dir() && !["target", "node_modules"].contains(&name.as_str()) && !name.starts_with('.') {
            files(&path, found);
        } else if (ends == "rs" || ends == "md") && name != "plain_words.rs" {
            found.push(path);
        }
    }
}

/// The comment of a line, and whether it is a doc comment.
fn comment(line: &str) -> Option<(&str, bool)> {
    let text = line.trim_start();
    let doc = text.strip_prefix("///").or_else(|| text.strip_prefix("//!"));
    doc.map(|text| (text.trim_start(), true)).or_else(|| {
        let (code, text) = line.split_once("// ")?;
        // Not the slashes of an address.
        (!code.ends_with(':')).then_some((text, false))
    })
}

/// The string literals of a line, as far as they begin and end in it.
fn strings(line: &str) -> impl Iterator<Item = &str> {
    line.split('"').skip(1).step_by(2)
}

/// True if a text has these words, one after the other.
fn has(text: &str, words: &str) -> bool {
    let (words, is_stem) = words.strip_suffix('*').map_or((words, false), |stem| (stem, true));
    text.match_indices(words).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + words.len()..].chars().next();
        let is_letter = |letter: Option<char>| letter.is_some_and(|letter| letter.is_alphanumeric() || letter == '_');
        !is_letter(before) && (is_stem || !is_letter(after))
    })
}

#[test]
fn no_banned_word() {
    let root = Path::new(linkage_tests::ROOT);
    let mut all = Vec::new();
    files(root, &mut all);
    assert!(all.len() > 400, "{} files", all.len());
    let mut found = String::new();
    let mut note = |path: &Path, number: usize, line: &str, instead: &str| {
        let path = path.strip_prefix(root).unwrap_or(path);
        if !ALLOWED.iter().any(|(end, text)| path.ends_with(end) && line.contains(text)) {
            writeln!(found, "{}:{}: write {instead}: {}", path.display(), number + 1, line.trim()).unwrap();
        }
    };
    for path in &all {
        let is_prose = path.extension().is_some_and(|end| end == "md");
        let text = fs::read_to_string(path).unwrap();
        let mut was_doc = false;
        for (number, line) in text.lines().enumerate() {
            let comment = if is_prose { Some((line, false)) } else { comment(line) };
            let (comment, is_doc) = comment.unwrap_or_default();
            if is_doc && !was_doc && FIRST.iter().any(|first| comment.starts_with(first)) {
                note(path, number, line, "a sentence or a noun phrase that names the thing");
            }
            was_doc = is_doc;
            let texts: Vec<String> =
                strings(line).filter(|_| !is_prose).chain([comment]).map(str::to_lowercase).collect();
            for (words, instead) in BANNED {
                if texts.iter().any(|text| has(text, words)) {
                    note(path, number, line, instead);
                }
            }
        }
    }
    assert!(found.is_empty(), "{} lines:\n{found}", found.lines().count());
}

/// True if a doc comment has two primes outside of code, which rustdoc would set as quotation marks.
fn has_bare_primes(comment: &str) -> bool {
    let is_prime =
        |at: usize, text: &str| text[..at].ends_with(|before: char| before.is_alphanumeric() || before == ')');
    comment.split('`').step_by(2).any(|text| text.match_indices("''").any(|(at, _)| is_prime(at, text)))
}

/// In docs of the library, and in the manual, a second derivative is code: `` `q''` ``.
#[test]
fn derivatives_are_code() {
    let root = Path::new(linkage_tests::ROOT);
    let mut all = Vec::new();
    files(root, &mut all);
    let inner = |path: &PathBuf| path.strip_prefix(root).unwrap_or(path).to_path_buf();
    let sources = all.iter().map(|path| (path, inner(path))).filter(|(_, path)| {
        let mut folders = path.iter().map(|folder| folder.to_string_lossy());
        folders.next().is_some_and(|first| first == "src" || first.starts_with("linkage-"))
            && path.iter().any(|folder| folder == "src")
    });
    let mut found = String::new();
    for (path, inner) in sources {
        let text = fs::read_to_string(path).unwrap();
        let is_prose = path.extension().is_some_and(|end| end == "md");
        let mut is_code = false;
        for (number, line) in text.lines().enumerate() {
            let doc = comment(line).filter(|(_, is_doc)| *is_doc).map(|(text, _)| text);
            let Some(doc) = is_prose.then_some(line).or(doc) else { continue };
            is_code ^= doc.trim_start().starts_with("```");
            if !is_code && has_bare_primes(doc) {
                writeln!(found, "{}:{}: {}", inner.display(), number + 1, line.trim()).unwrap();
            }
        }
    }
    assert!(found.is_empty(), "{} lines:\n{found}", found.lines().count());
    assert!(has_bare_primes("from q'' and v''") && !has_bare_primes("`q''` is ''"));
}

#[test]
fn banned_words_are_found() {
    assert!(has("the size beside the scale", "beside") && !has("besides", "beside"));
    assert!(has("it is judged", "judge*") && !has("prejudge", "judge*"));
    assert_eq!(comment("/// What it is."), Some(("What it is.", true)));
    assert_eq!(comment("    let x = 1; // ten ulps"), Some(("ten ulps", false)));
    assert_eq!(comment("https://example.org"), None);
    assert_eq!(strings(r#"panic!("a verdict", "b")"#).collect::<Vec<_>>(), ["a verdict", "b"]);
}
