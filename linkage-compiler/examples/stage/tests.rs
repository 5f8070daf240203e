//! ARCHITECTURE.md shows what the command prints, and a mistake in the command has one message.
//!
//! `INSTA_UPDATE=always cargo test -p linkage-compiler --example stage` writes the texts of the document anew.

use std::path::{Path, PathBuf};
use std::{env, fs};

use super::{STAGES, run};

/// The fence of the blocks of the document: doc comments in them have one of three signs.
const FENCE: &str = "````";

/// The four-bar of the document, from the folder in which tests run.
const FOUR_BAR: &str = "examples/stage/four_bar.rs";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The text that belongs after the first line of a block of the document: what `stage ARGUMENTS` or `cat FILE` prints.
fn printed(command: &str) -> String {
    let words: Vec<&str> = command.split_whitespace().collect();
    match words.as_slice() {
        ["$", "cat", file] => fs::read_to_string(root().join(file)).unwrap(),
        ["$", "stage", file, rest @ ..] => {
            let file = root().join(file).display().to_string();
            run(&[&[file.as_str()], rest].concat()).unwrap()
        }
        _ => panic!("`{command}` is not a command of this document"),
    }
}

/// The document with the blocks of each `console` written anew, and the commands of these.
fn renewed(document: &str) -> (String, Vec<String>) {
    let (mut text, mut commands) = (String::new(), Vec::new());
    let mut lines = document.lines();
    while let Some(line) = lines.next() {
        text += &format!("{line}\n");
        if line == format!("{FENCE}console") {
            let command = lines.next().unwrap();
            let end = lines.by_ref().find(|line| *line == FENCE).unwrap();
            text += &format!("{command}\n{}\n{end}\n", printed(command).trim_end());
            commands.push(command.to_owned());
        }
    }
    (text, commands)
}

#[test]
fn the_document_shows_what_the_command_prints() {
    let path = root().join("ARCHITECTURE.md");
    let document = fs::read_to_string(&path).unwrap();
    let (text, commands) = renewed(&document);
    if env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        fs::write(&path, text).unwrap();
    } else if let Some((line, (is, new))) =
        document.lines().zip(text.lines()).enumerate().find(|(_, (is, new))| is != new)
    {
        panic!("ARCHITECTURE.md:{}: `{is}` is now `{new}`: set INSTA_UPDATE=always and review it", line + 1);
    } else {
        assert_eq!(document, text, "ARCHITECTURE.md: set INSTA_UPDATE=always and review it");
    }
    let unshown = STAGES.iter().map(|(name, ..)| *name).filter(|name| {
        *name != "document" && !commands.iter().any(|command| command.split_whitespace().any(|word| word == *name))
    });
    assert_eq!(unshown.collect::<Vec<_>>(), [""; 0], "a stage that the document does not show");
}

/// The folders and files that the document names in code: each exists.
#[test]
fn the_document_names_what_exists() {
    for name in ["ARCHITECTURE.md", "CONTRIBUTING.md"] {
        let document = fs::read_to_string(root().join(name)).unwrap();
        // Outside of fenced blocks.
        let prose: String = document.split(FENCE).step_by(2).collect();
        let paths: Vec<&str> = prose
            .split('`')
            .skip(1)
            .step_by(2)
            .filter(|code| !code.contains(' '))
            .filter(|code| code.ends_with('/') || code.ends_with(".rs") || code.ends_with(".md"))
            .collect();
        assert!(paths.len() >= 3, "{name}: {paths:?}");
        for path in paths {
            let folders = ["", "linkage-compiler/src"];
            assert!(folders.iter().any(|folder| root().join(folder).join(path).exists()), "{name}: {path}");
        }
    }
}

#[test]
fn a_mistake_has_one_message() {
    let stages = "`statements`, `mechanism`, `groups`, `derivation`, `document`, `plan`, `code`, `rust` or `fpcore`";
    let folder = "examples/stage";
    let unread = |path: &str| fs::read_to_string(path).unwrap_err().to_string();
    let table: [(&[&str], String); 12] = [
        (&[FOUR_BAR, "tokens"], format!("there is no stage `tokens`: write {stages}")),
        (&[FOUR_BAR, "code", "Fourbar"], format!("there is no mechanism `Fourbar` in {FOUR_BAR}: write `FourBar`")),
        (
            &[FOUR_BAR, "code", "FourBar", "velocity_ratio"],
            format!(
                "{FOUR_BAR}: there is no function `velocity_ratio` of `FourBar` in the stage `code`, \
                 did you mean `velocity_ratios`?"
            ),
        ),
        (
            &[FOUR_BAR, "code", "FourBar", "energy"],
            format!(
                "{FOUR_BAR}: there is no function `energy` of `FourBar` in the stage `code`: \
                 leave it out for all functions"
            ),
        ),
        (
            &[FOUR_BAR, "groups", "FourBar", "pose_at"],
            "the stage `groups` has no functions such as `pose_at`: write `plan`, `code`, `rust` or `fpcore`"
                .to_owned(),
        ),
        (
            &["none.rs", "code"],
            format!("none.rs: {}; write the path of a Rust file with `linkage! {{ … }}`", unread("none.rs")),
        ),
        (
            &[folder, "code"],
            format!("{folder}: {}; write the path of a Rust file with `linkage! {{ … }}`", unread(folder)),
        ),
        (
            &["src/lib.rs", "code"],
            "src/lib.rs has no mechanism: write the path of a file with `linkage! { … }`".to_owned(),
        ),
        (
            &["../LICENSE-MIT", "code"],
            "../LICENSE-MIT has no mechanism: write the path of a file with `linkage! { … }`".to_owned(),
        ),
        (
            &["../dev/ci", "code"],
            "../dev/ci is not read: cannot parse string into token stream; write the path of a Rust file".to_owned(),
        ),
        (
            &["../tests/messages/ui/missing_semicolon.rs", "groups"],
            "../tests/messages/ui/missing_semicolon.rs: expected `;` before this".to_owned(),
        ),
        (&[], super::usage()),
    ];
    for (arguments, message) in table {
        assert_eq!(run(arguments), Err(message), "{arguments:?}");
    }
}

/// Scenes, groups without closed form, user functions, open chains, choices of the input: each stage has a text.
#[test]
fn every_stage_prints_other_constructs() {
    let files =
        ["slider_crank_contacts", "cam_rocker", "double_butterfly", "double_pendulum", "five_bar", "norton_four_bar"];
    for file in files {
        let path = root().join(format!("dev/gallery/src/mechanisms/{file}.rs")).display().to_string();
        for (stage, ..) in STAGES {
            let text = run(&[&path, stage]).unwrap();
            assert!(text.lines().count() >= 2, "{file}: {stage}: {text}");
        }
    }
}
