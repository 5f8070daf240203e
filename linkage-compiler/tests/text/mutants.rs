//! Mutants of the gallery's texts, letter by letter and word by word: each ends with mechanisms or with messages on its own
//! letters, within the budget.
//!
//! `MUTANTS` is their number, `MUTANTS_SEED` chooses others. One of a hundred that pass is compiled.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use linkage_compiler::budget::Budget;
use linkage_compiler::text;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Pieces of texts, right and wrong.
const PIECES: [&str; 48] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ";",
    ",",
    "=",
    "@",
    "+",
    "-",
    "*",
    "/",
    "^",
    "..",
    "#",
    "'",
    "\"",
    "|",
    "!",
    "\u{2212}",
    "\u{b0}",
    "\u{0}",
    "\r",
    "\n",
    "/*",
    "*/",
    "//",
    "0x",
    "1e999",
    "1e-999",
    "9223372036854775807",
    "0.1.2",
    "2theta",
    "''",
    "r#type",
    "self",
    "_",
    "\u{3b8}",
    "\u{feff}",
    "#[cfg(x)]",
    "/// a\n",
    "implied",
    "loop",
    "rate(t)",
    "30deg",
    "\\u",
];

/// The insides of the invocations of the gallery's files.
fn corpus() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../dev/gallery/src/mechanisms");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let texts = files.into_iter().map(|file| {
        let text = fs::read_to_string(&file).unwrap();
        let (_, inside) = text.split_once("linkage! {").unwrap_or_else(|| panic!("{}", file.display()));
        inside[..inside.rfind('}').unwrap()].to_owned()
    });
    texts.collect()
}

struct Mutator {
    random: SmallRng,
    corpus: Vec<String>,
}

impl Mutator {
    fn below(&mut self, count: usize) -> usize {
        self.random.random_range(0..count.max(1))
    }

    /// The text of a mechanism with one to four changes.
    fn mutant(&mut self) -> String {
        let place = self.below(self.corpus.len());
        let mut text = self.corpus[place].clone();
        for _ in 0..1 + self.below(10).saturating_sub(6) {
            text = self.changed(&text);
        }
        text
    }

    fn changed(&mut self, text: &str) -> String {
        let words: Vec<&str> = words(text);
        if words.is_empty() {
            return PIECES[self.below(PIECES.len())].to_owned();
        }
        let [at, other] = [self.below(words.len()), self.below(words.len())];
        let mut changed: Vec<&str> = words.clone();
        match self.below(9) {
            0 => drop(changed.remove(at)),
            1 => changed.insert(at, words[other]),
            2 => changed.swap(at, other),
            3 => changed[at] = words[other],
            4 => changed.insert(at, PIECES[self.below(PIECES.len())]),
            5 => changed[at] = PIECES[self.below(PIECES.len())],
            6 => changed.truncate(at),
            7 => {
                let (from, to) = (at.min(other), at.max(other).min(at.min(other) + 40));
                let again = words[from..to].to_vec();
                changed.splice(to..to, again);
            }
            _ => {
                // A letter less or twice.
                let letters: Vec<char> = words[at].chars().collect();
                let letter = self.below(letters.len());
                let is_twice = self.below(2) == 0;
                let of = |(index, one): (usize, &char)| {
                    vec![
                        *one;
                        if index != letter {
                            1
                        } else if is_twice {
                            2
                        } else {
                            0
                        }
                    ]
                };
                let word: String = letters.iter().enumerate().flat_map(of).collect();
                return [words[..at].concat(), word, words[at + 1..].concat()].concat();
            }
        }
        changed.concat()
    }
}

/// Words, runs of blanks, and single signs.
fn words(text: &str) -> Vec<&str> {
    let kind = |letter: char| match letter {
        _ if letter.is_alphanumeric() || letter == '_' => 1,
        _ if letter.is_whitespace() => 2,
        _ => 0,
    };
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let of_kind = |letter: char| kind(first) == 0 || kind(letter) != kind(first);
        let end = rest[first.len_utf8()..].find(of_kind).map_or(rest.len(), |end| end + first.len_utf8());
        let (word, after) = rest.split_at(end);
        words.push(word);
        rest = after;
    }
    words
}

/// Each message lies on letters of the text, in the order of places.
fn check(messages: &[text::Message], text: &str) {
    assert!(!messages.is_empty() && messages.is_sorted(), "{messages:?}\n{text}");
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for message in messages {
        let line = text.split('\n').nth(message.line - 1).unwrap_or_else(|| panic!("{message}:\n{text}"));
        let end = message.column - 1 + message.length;
        assert!(message.column > 0 && end <= line.chars().count(), "{message:?}:\n{text}");
        let is_of_all = message.text.starts_with("the text has no mechanism");
        assert!(message.length > 0 || is_of_all, "{message:?}:\n{text}");
        assert!(!message.text.is_empty(), "{message:?}:\n{text}");
    }
}

#[test]
fn no_mutant_of_a_text_panics_or_runs_away() {
    let count = linkage_trials::count("MUTANTS", 300, 1500);
    let own = linkage_trials::count("MUTANTS_SEED", 1, 1);
    let mut mutator = Mutator { random: SmallRng::seed_from_u64(linkage_trials::seed(own)), corpus: corpus() };
    let (mut passed, mut compiled, mut said) = (0, 0, 0);
    for number in 1..=count {
        let text = mutator.mutant();
        let work = || {
            let budget = Budget::default();
            let found = text::read(&text, &budget).map(|mechanisms| mechanisms.len());
            assert!(budget.left() > 0 || found.is_err());
            let is_compiled = found.is_ok() && number % 100 == 0;
            let compiled = is_compiled.then(|| text::compile(&text, &Budget::default(), |_| ()).map(|all| all.len()));
            (found, compiled)
        };
        let (found, of_compiler) =
            catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| panic!("mutant {number} panics:\n{text}"));
        for messages in [found.as_ref().err(), of_compiler.as_ref().and_then(|found| found.as_ref().err())] {
            messages.into_iter().for_each(|messages| check(messages, &text));
        }
        passed += usize::from(found.is_ok());
        said += found.err().map_or(0, |messages| messages.len());
        compiled += usize::from(of_compiler.is_some_and(|found| found.is_ok()));
    }
    println!("{count} mutants, {passed} passed, {compiled} compiled, {said} messages");
    // If all were rejected for one reason, the test would check it only.
    assert!(20 * passed > count && said > count / 2, "{passed} of {count} passed, {said} messages");
}
