//! Programs with mistakes, one a file: the messages as a user sees them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::checked::{compare, messages, package};

#[test]
fn mistakes() {
    let programs = fs::read_dir(Path::new(linkage_tests::ROOT).join("tests/messages/ui")).unwrap();
    let programs = programs.map(|entry| entry.unwrap().path());
    let name_of = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let mut seen: BTreeMap<String, String> = BTreeMap::new();
    let files: Vec<(String, String)> = programs
        .map(|path| {
            seen.insert(name_of(&path), String::new());
            (format!("src/bin/{}.rs", name_of(&path)), fs::read_to_string(&path).unwrap())
        })
        .collect();
    let root = fs::canonicalize(linkage_tests::ROOT).expect("the workspace");
    for line in messages(&package("ui", files), &["--bins"]) {
        let of = line["target"]["name"].as_str().and_then(|name| seen.get_mut(name)).expect("a program");
        *of += &without_lines(line["message"]["rendered"].as_str().expect("a text"), &root);
    }
    for (name, text) in &seen {
        assert!(text.contains("error"), "{name} has no mistake:\n{text}");
    }
    compare("ui", &seen.into_iter().collect::<Vec<_>>());
}

/// A message without the folder of the workspace, and without the numbers of lines in its files, which change.
fn without_lines(text: &str, root: &Path) -> String {
    let folder = format!("{}/", root.display());
    let mut is_outside = false;
    let lines = text.lines().map(|line| {
        if line.trim_start().starts_with("::: ") || line.trim_start().starts_with("--> ") {
            is_outside = line.contains(&folder);
            let file = line.replace(&folder, "");
            return if is_outside {
                file.split(".rs:").next().unwrap_or_default().to_owned() + ".rs\n"
            } else {
                file + "\n"
            };
        }
        match line.split_once('|') {
            Some((number, code)) if is_outside => format!("{}|{code}\n", " ".repeat(number.len())),
            _ => format!("{line}\n"),
        }
    });
    lines.collect()
}
