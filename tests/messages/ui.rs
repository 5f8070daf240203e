//! Programs with mistakes, one a file: the messages as a user sees them.
//!
//! The library gives the messages of the macro in this process. A program with one of rustc itself goes through rustc, and so
//! do one in ten of the others, other ones for each commit, and all in the outer ring.

use std::fs;
use std::path::Path;

use linkage_compiler::budget::Budget;
use linkage_compiler::text;
use linkage_tests::programs::written;
use linkage_tests::turn;
use linkage_trials::is_outer;

use super::checked::{compare, messages, snapshot};
use super::one_message::insides;

#[test]
fn mistakes() {
    let entries = fs::read_dir(Path::new(linkage_tests::ROOT).join("tests/messages/ui")).unwrap();
    let mut programs: Vec<(String, String)> = entries
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(&path).unwrap()))
        .collect();
    programs.sort();
    let turned = turn::of(programs.len(), 10);
    let is_checked = |place: usize, (name, program): &(String, String)| {
        is_outer() || turned(place) || in_order(&snapshot("ui", name)) != in_order(&of_library(name, program))
    };
    let checked: Vec<_> =
        programs.iter().enumerate().filter(|(place, one)| is_checked(*place, one)).map(|(_, one)| one).collect();
    println!("{} of {} programs through rustc", checked.len(), programs.len());
    assert!(is_outer() || 2 * checked.len() < programs.len(), "the library gives the messages of few programs");
    let file = |name: &str| format!("src/bin/{name}.rs");
    let folder = written("ui", checked.iter().map(|(name, program)| (file(name), program.clone())));
    let text_of = |name: &str| {
        let found = messages(&folder, &file(name), "bin");
        found.iter().map(|line| without_lines(line["rendered"].as_str().expect("a text"))).collect::<String>()
    };
    let texts: Vec<(String, String)> = checked.iter().map(|(name, _)| (name.clone(), text_of(name))).collect();
    for (name, text) in &texts {
        assert!(text.contains("error"), "{name} has no mistake:\n{text}");
    }
    compare("ui", &texts, programs.iter().map(|(name, _)| name.as_str()));
}

/// The messages of the library for the mechanisms of a program, as rustc shows those of the macro.
fn of_library(name: &str, program: &str) -> String {
    let found = insides(program).into_iter().map(|inside| text::compile(&inside, &Budget::default(), |_| ()));
    let shown = |message: text::Message| {
        let text::Message { line, column, length, text, help } = message;
        let help: String = help.iter().flat_map(|help| help.lines()).map(|line| format!("\n       {line}")).collect();
        let (margin, source) = (" ".repeat(line.to_string().len()), program.lines().nth(line - 1).unwrap_or_default());
        let marks = " ".repeat(column - 1) + &"^".repeat(length);
        format!(
            "error: {text}{help}\n{margin}--> src/bin/{name}.rs:{line}:{column}\n{margin} |\n{line} | {source}\n{margin} | {marks}\n\n"
        )
    };
    found.filter_map(Result::err).flatten().map(shown).collect()
}

/// Messages in the order of their texts.
fn in_order(messages: &str) -> Vec<&str> {
    let mut all: Vec<&str> = messages.trim_end().split("\n\n").collect();
    all.sort_unstable();
    all
}

/// A message without the numbers of lines in files of the workspace, which change.
fn without_lines(text: &str) -> String {
    let mut is_outside = false;
    let lines = text.lines().map(|line| {
        if let Some((_, file)) = line.split_once("--> ").or_else(|| line.split_once("::: ")) {
            is_outside = !file.starts_with("src/bin/");
            return match line.split_once(".rs:") {
                Some((file, _)) if is_outside => format!("{file}.rs\n"),
                _ => format!("{line}\n"),
            };
        }
        match line.split_once('|') {
            Some((number, code)) if is_outside => format!("{}|{code}\n", " ".repeat(number.len())),
            _ => format!("{line}\n"),
        }
    });
    lines.collect()
}
